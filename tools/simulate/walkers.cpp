#include "tools/simulate/walkers.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace floornav {
namespace {

constexpr double kPersonalSpace_m =
    1.2;  ///< between the middles of robot and person: half a metre between their hulls

}  // namespace

Walkers::Walkers(const Scene& scene)
    : scene_(scene), walked_s_(scene.people.size(), 0.0), waited_s_(scene.people.size(), 0.0) {}

void Walkers::walk(const Eigen::Vector2d& robot_m, double time_s) {
  for (std::size_t i = 0; i < walked_s_.size(); ++i) {
    const double next_s = walked_s_[i] + time_s;
    const double then_m = (scene_.people[i].place_m(next_s) - robot_m).norm();
    const bool goes_on = then_m > kPersonalSpace_m || then_m > (place_of(i) - robot_m).norm();
    if (goes_on) walked_s_[i] = next_s;
    waited_s_[i] = goes_on ? 0.0 : waited_s_[i] + time_s;
  }
}

Eigen::Vector2d Walkers::place_of(std::size_t person) const {
  return scene_.people[person].place_m(walked_s_[person]);
}

Shapes Walkers::world() const {
  Shapes shapes = scene_.fixed;
  const auto people = scene_.people_at(walked_s_);
  shapes.cylinders.insert(shapes.cylinders.end(), people.begin(), people.end());
  return shapes;
}

std::string Walkers::meeting(const DriveBase& robot) const {
  if (walked_s_.empty()) return {};
  Shapes people;
  people.ground = scene_.fixed.ground;
  people.cylinders = scene_.people_at(walked_s_);
  return robot.touched(people).empty() ? std::string() : tell(robot);
}

std::string Walkers::tell(const DriveBase& robot) const {
  const Eigen::Vector2d here = robot.state().position_m;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < walked_s_.size(); ++i)
    if ((place_of(i) - here).norm() < (place_of(nearest) - here).norm()) nearest = i;
  const Eigen::Vector2d way = place_of(nearest) - here;
  const Eigen::Vector2d ahead = robot.state().ahead;
  const double bearing_rad = std::atan2(ahead.x() * way.y() - ahead.y() * way.x(), ahead.dot(way));
  return fmt::format(
      "hit a person {:.2f} m away, {:.0f} deg to the left, who {}; robot {:.2f} m/s, turning {:.2f} rad/s",
      way.norm(), bearing_rad * 180.0 / std::numbers::pi,
      waited_s_[nearest] > 0 ? fmt::format("had waited {:.1f} s", waited_s_[nearest]) : std::string("walked"),
      robot.speed_mps(), robot.turn_radps());
}

}  // namespace floornav
