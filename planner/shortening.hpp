#pragma once

#include <vector>

#include "planner/planning_grid.hpp"

namespace floornav {

/// Leaves out cells of a path between which the straight line is clear and costs no more than the path does,
/// and the turns at its ends are clear, the first from `heading_rad`. A stretch over known free floor stays
/// on it, and does not merge with one over unknown floor.
std::vector<GridPoint> shorten(const PlanningGrid& grid, const std::vector<GridCell>& path,
                               double heading_rad);

}  // namespace floornav
