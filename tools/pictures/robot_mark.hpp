#pragma once

#include <Eigen/Core>

#include "tools/pictures/color.hpp"
#include "tools/pictures/top_view.hpp"

namespace floornav {

/// A robot seen from above.
struct RobotMark {
  Eigen::Vector2d place_m;
  double heading_rad = 0;
  double radius_m = 0.45;
};

inline constexpr Color kRobotColor = color(0x8A3FBF);

/// A circle of the robot's radius with an arrow in it.
void draw_robot(TopView& view, const RobotMark& robot);

}  // namespace floornav
