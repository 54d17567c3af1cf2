#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "planner/planning_grid.hpp"
#include "planner/search/line_of_sight.hpp"
#include "planner/search/search_grid.hpp"
#include "runtime/geometry/lattice.hpp"

namespace floornav {

/// Of the straight line from one place to another.
inline double heading_between(GridPoint a, GridPoint b) {
  return std::atan2(b.y - a.y, b.x - a.x);
}

/// Straight lines from corner to corner, in columns and rows of a grid whose cell (0, 0) is `origin` of the
/// map.
struct Route {
  CellIndex origin;
  std::vector<GridPoint> corners;
  std::size_t way_out = 0;  ///< that many lines at its begin lead out of where the robot does not fit
};

/// The same route on a grid with another origin.
Route moved(const Route& route, CellIndex origin);

/// Every line of the route but those of its way out is clear (line_clear), and so is every turn, the first
/// from `heading_rad`.
bool route_open(const PlanningGrid& grid, const Route& route, double heading_rad);

/// What a route costs: its lines but those of its way out (line_cost), and `turn_cost` (in steps) for every
/// radian of its turns, that from `heading_rad` at its begin included.
double route_cost(const SearchGrid& grid, const Route& route, double heading_rad, double turn_cost);

/// What is left of a route, its way out apart, for one who stands at `here`: the corners after the line
/// nearest to it. Nothing where it is further than `reach` (cells) from all of them.
std::optional<std::vector<GridPoint>> corners_ahead(const Route& route, GridPoint here, double reach);

}  // namespace floornav
