#pragma once

#include <algorithm>

#include "runtime/geometry/robot.hpp"

namespace floornav {

/// T of eq. (2), m: what the wheels take and the chassis clears.
inline double step_limit_m(const RobotSettings& robot) {
  return std::min(robot.max_step_m, robot.ground_clearance_m);
}

}  // namespace floornav
