#pragma once

#include "planner/planning_grid.hpp"
#include "planner/search/line_of_sight.hpp"

namespace floornav {

/// How much of the straight way from a to b, 0..1 from a on, the robot's circle keeps to known free (or
/// assumed) floor: the cells whose centres surround each place of it all do (PlanningGrid::known_free).
double known_free_part(const PlanningGrid& grid, GridPoint a, GridPoint b);

}  // namespace floornav
