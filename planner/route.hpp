#pragma once

#include <optional>
#include <vector>

#include "planner/planning_grid.hpp"
#include "planner/search/line_of_sight.hpp"
#include "planner/search/search_grid.hpp"
#include "runtime/geometry/lattice.hpp"

namespace floornav {

/// Straight lines from corner to corner, in columns and rows of a grid whose cell (0, 0) is `origin` of the
/// map.
struct Route {
  CellIndex origin;
  std::vector<GridPoint> corners;
};

/// The same route on a grid with another origin.
Route moved(const Route& route, CellIndex origin);

/// Leaves out cells of a path between which the straight line is open and costs no more than the path does. A
/// stretch over known free floor stays on it, and does not merge with one over unknown floor.
std::vector<GridPoint> shorten(const PlanningGrid& grid, const std::vector<GridCell>& path);

/// Every line of the route is open (line_open).
bool route_open(const SearchGrid& grid, const std::vector<GridPoint>& corners);

/// As line_cost, of all lines together.
double route_cost(const SearchGrid& grid, const std::vector<GridPoint>& corners);

/// What is left of a route for one who stands at `here`: the corners after the line nearest to it. Nothing
/// where it is further than `reach` (cells) from all of them.
std::optional<std::vector<GridPoint>> corners_ahead(const std::vector<GridPoint>& corners, GridPoint here,
                                                    double reach);

}  // namespace floornav
