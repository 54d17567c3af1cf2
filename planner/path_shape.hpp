#pragma once

#include <vector>

#include "mapping/grid_map.hpp"
#include "planner/plan.hpp"
#include "planner/planning_grid.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// The part of a route that may be driven now, as points without speeds.
struct DrivablePath {
  std::vector<PathPoint> points;
  double length_m = 0;
  std::size_t way_out_points = 0;
  bool whole = false;  ///< it leads to the route's end
};

/// Follows the route from the robot's pose as far as its footprint overlaps known free (or assumed) floor
/// only, and rounds its corners as far as there is room. Points lie no more than `spacing_m` apart. Before
/// the first height that the map knows the floor is as high as the pose.
DrivablePath drivable_path(const PlanningGrid& grid, const GridMap& map, const Route& route,
                           const RobotSettings& robot, double spacing_m, const Pose& T_world_body);

}  // namespace floornav
