#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mapping/belief.hpp"
#include "runtime/geometry/robot.hpp"
#include "runtime/geometry/step_limit.hpp"

namespace floornav {

/// Rise per metre of the steepest floor: what the robot drives, and on which it does not tip over sideways in
/// its quickest turn. On a slope it tips where height x (rise + v w / g) exceeds half the track.
inline double steepest_rise(const RobotSettings& robot) {
  constexpr double kGravity_mps2 = 9.81;
  const double by_drive = std::tan(robot.max_slope_deg * std::numbers::pi / 180);
  const double turning = robot.max_speed_mps * robot.max_turn_rate_radps / kGravity_mps2;
  const double by_tipping = 0.5 * robot.track_m / robot.center_of_gravity_m - turning;
  return std::clamp(by_tipping, 0.0, by_drive);
}

/// The least belief of section 4.6 with which a robot drives on a vertex: that of its steepest floor, where
/// that rises over two blocks of FloorHeight. It follows from slope limit, centre of gravity and speed.
inline double least_belief(const RobotSettings& robot) {
  constexpr double kTwoBlocks_m = 1.6;
  const double rise = steepest_rise(robot);
  const double slope_deg = std::atan(rise) * 180 / std::numbers::pi;
  return static_cast<double>(belief(static_cast<float>(kTwoBlocks_m * rise), static_cast<float>(slope_deg)));
}

}  // namespace floornav
