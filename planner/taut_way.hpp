#pragma once

#include <vector>

#include "planner/planning_grid.hpp"

namespace floornav {

/// Pulls a way between centres of cells taut: moves, adds and leaves out corners as long as its lines
/// (line_cost) and `turn_cost` (in steps) for every radian turned, the first turn being that from
/// `heading_rad`, come to less. A search over cells goes in eight directions only, so that no choice among
/// the cells of its path gives the cheapest way around an obstacle. Lines and turns that were clear stay
/// clear, stretches over known free floor stay on it, and where one ends its corner stays.
std::vector<GridPoint> pulled_taut(const PlanningGrid& grid, std::vector<GridPoint> corners,
                                   double heading_rad, double turn_cost);

}  // namespace floornav
