#pragma once

#include "planner/planning_grid.hpp"

namespace floornav {

/// Whether the robot's outline overlaps nothing where it stands.
bool fits(const PlanningGrid& grid, GridPoint at, double heading_rad, Avoid avoid);

/// Whether the robot may drive straight from a to b: over no closed edge, its outline over nothing blocked.
bool line_clear(const PlanningGrid& grid, GridPoint a, GridPoint b);

/// Whether it may turn in place, the short way round; a circle always may.
bool turn_clear(const PlanningGrid& grid, GridPoint at, double from_rad, double to_rad, Avoid avoid);

/// How much of the straight way from a to b, 0..1 from a on, the robot keeps to known free (or assumed)
/// floor: the cells whose centres surround each place of it all do (PlanningGrid::known_free), and its
/// outline overlaps nothing blocked or unknown.
double known_free_part(const PlanningGrid& grid, GridPoint a, GridPoint b);

}  // namespace floornav
