#include "tools/pictures/robot_mark.hpp"

#include <array>
#include <cmath>

namespace floornav {

void draw_robot(TopView& view, const RobotMark& robot) {
  const auto corner = [&](double angle, double reach) {
    const double direction = robot.heading_rad + angle;
    return view.at(robot.place_m +
                   reach * robot.radius_m * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
  };
  view.canvas().disc(view.at(robot.place_m), robot.radius_m * view.pixels_per_m(), kRobotColor, 0.25);
  view.canvas().circle(view.at(robot.place_m), robot.radius_m * view.pixels_per_m(), {kRobotColor, 1.5});
  view.canvas().polygon(std::array{corner(0, 0.85), corner(2.5, 0.6), corner(0, -0.25), corner(-2.5, 0.6)},
                        kRobotColor);
}

}  // namespace floornav
