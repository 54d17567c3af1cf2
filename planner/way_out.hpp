#pragma once

#include <optional>
#include <vector>

#include "planner/planning_grid.hpp"

namespace floornav {

/// For a robot that stands where it does not fit, since an obstacle or a closed edge is nearer than its size
/// allows (noise, a person who came close, drift): the cells from its own to the nearest one where it fits
/// whatever its heading,
/// on a way that comes no nearer to any obstacle than it is already, crosses no closed edge and keeps its
/// centre off unknown floor. Only the cell itself where it fits there. Nothing where there is no such way
/// within `reach_m`.
std::optional<std::vector<GridCell>> way_out(const PlanningGrid& grid, GridCell from, double reach_m);

}  // namespace floornav
