#pragma once

#include <vector>

#include "planner/plan.hpp"
#include "planner/settings.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Sets the speed of every point: the most that slope, clearance and the turn at the point allow, such that
/// the robot's acceleration brings it from each to the next and to rest at the last.
void set_speeds(std::vector<PathPoint>& points, const PlannerSettings& settings, const RobotSettings& robot);

}  // namespace floornav
