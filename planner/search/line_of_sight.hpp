#pragma once

#include <cmath>

#include "planner/search/search_grid.hpp"

namespace floornav {

/// A place on a grid in coordinates of columns and rows: cell (i, j) has its centre at (i, j).
struct GridPoint {
  double x = 0;
  double y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

inline GridPoint centre(GridCell cell) {
  return {static_cast<double>(cell.x), static_cast<double>(cell.y)};
}

/// The cell that holds a place; it may lie off the grid.
inline GridCell cell_at(GridPoint p) {
  return {static_cast<std::int32_t>(std::floor(p.x + 0.5)), static_cast<std::int32_t>(std::floor(p.y + 0.5))};
}

/// Whether one may go straight from a to b over open edges only: the line keeps to open edges, where it runs
/// along them, and elsewhere to squares of four cells all of whose edges, diagonals included, are open. False
/// off the grid.
bool line_open(const SearchGrid& grid, GridPoint a, GridPoint b);

/// What the straight line costs, in lengths of a straight step over cells of weight 0. It must be on the
/// grid.
double line_cost(const SearchGrid& grid, GridPoint a, GridPoint b);

}  // namespace floornav
