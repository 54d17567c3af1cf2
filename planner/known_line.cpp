#include "planner/known_line.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr double kSampleCells = 0.25;  ///< least_gap_of in planning_grid.cpp counts on it

bool is_known_free(const PlanningGrid& grid, GridCell cell) {
  return grid.search_grid().contains(cell) && grid.known_free(cell);
}

/// Four cells surround a place; two where it lies between the centres of two neighbours, one in its centre.
bool known_free_at(const PlanningGrid& grid, GridPoint p) {
  constexpr double kRounding = 1e-9;
  const auto x = static_cast<std::int32_t>(std::floor(p.x + kRounding));
  const auto y = static_cast<std::int32_t>(std::floor(p.y + kRounding));
  const double dx = p.x - x, dy = p.y - y;
  const std::int32_t right = dx > kRounding ? x + 1 : x, above = dy > kRounding ? y + 1 : y;
  const bool on_rising = is_known_free(grid, {x, y}) && is_known_free(grid, {right, above});
  const bool on_falling = is_known_free(grid, {right, y}) && is_known_free(grid, {x, above});
  if (std::abs(dx - dy) < kRounding && on_rising) return true;
  if (std::abs(dx + dy - 1) < kRounding && on_falling) return true;
  return on_rising && on_falling;
}

}  // namespace

double known_free_part(const PlanningGrid& grid, GridPoint a, GridPoint b) {
  const int samples =
      std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / kSampleCells)));
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    if (!known_free_at(grid, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}))
      return static_cast<double>(std::max(0, i - 1)) / samples;
  }
  return 1.0;
}

}  // namespace floornav
