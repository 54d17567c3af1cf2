#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "planner/cell_rect.hpp"
#include "planner/search/line_of_sight.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

/// The cell nearest to a point that suits, no further than `reach` from it; of equally near ones the first by
/// row.
template <class Suits>
std::optional<GridCell> nearest_cell(const SearchGrid& grid, GridPoint point, double reach,
                                     const Suits& suits) {
  const CellRect all{0, 0, grid.width, grid.height};
  const auto low = [&](double v) { return static_cast<std::int32_t>(std::max(std::floor(v - reach), -1.0)); };
  const auto high = [&](double v) {
    return static_cast<std::int32_t>(std::min(std::ceil(v + reach) + 1, 65536.0));
  };
  const CellRect rect = CellRect{low(point.x), low(point.y), high(point.x), high(point.y)}.clipped(all);
  std::optional<GridCell> best;
  double nearest = reach;
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const double d = std::hypot(x - point.x, y - point.y);
      if (d > nearest || (best && d == nearest) || !suits(GridCell{x, y})) continue;
      nearest = d;
      best = GridCell{x, y};
    }
  }
  return best;
}

}  // namespace floornav
