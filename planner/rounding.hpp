#pragma once

#include <vector>

#include "planner/planning_grid.hpp"

namespace floornav {

/// A path with arcs, as short lines, in place of its corners: each as wide as `radius` (cells) asks for, or
/// as half the lines beside it and the room there allow; every line of it is open, and known to be free where
/// what it replaces was. A corner without room stays. The first `fixed` lines are left as they are.
std::vector<GridPoint> rounded(const PlanningGrid& grid, const std::vector<GridPoint>& corners,
                               std::size_t fixed, double radius);

}  // namespace floornav
