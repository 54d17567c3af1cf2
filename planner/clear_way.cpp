#include "planner/clear_way.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

GridPoint between(GridPoint a, GridPoint b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

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

/// The same for the inner circle alone.
double known_part_of_circle(const PlanningGrid& grid, GridPoint a, GridPoint b, int samples) {
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    if (!known_free_at(grid, between(a, b, t))) return static_cast<double>(std::max(0, i - 1)) / samples;
  }
  return 1.0;
}

bool clear(const PlanningGrid& grid, const ConvexArea& area, Avoid avoid) {
  const std::vector<RowSpan> spans = cells_under(area);
  return std::all_of(spans.begin(), spans.end(), [&](const RowSpan& span) {
    return grid.clear(span, {0, 0}, avoid);
  });
}

/// Nothing is near enough for the outline to matter.
bool all_roomy(const PlanningGrid& grid, GridPoint a, GridPoint b) {
  const auto is_roomy = [&](GridPoint p) {
    const GridCell cell = cell_at(p);
    return grid.search_grid().contains(cell) && grid.roomy(cell);
  };
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y))));
  for (int i = 0; i <= pieces; ++i)
    if (!is_roomy(between(a, b, static_cast<double>(i) / pieces))) return false;
  return true;
}

}  // namespace

bool fits(const PlanningGrid& grid, GridPoint at, double heading_rad, Avoid avoid) {
  return grid.outline().is_circle() || clear(grid, grid.outline().along(at, at, heading_rad), avoid);
}

bool line_clear(const PlanningGrid& grid, GridPoint a, GridPoint b) {
  if (!line_open(grid.search_grid(), a, b)) return false;
  return grid.outline().is_circle() || a == b || all_roomy(grid, a, b) ||
         clear(grid, grid.outline().along(a, b), Avoid::kBlocked);
}

bool turn_clear(const PlanningGrid& grid, GridPoint at, double from_rad, double to_rad, Avoid avoid) {
  if (grid.outline().is_circle()) return true;
  if (avoid == Avoid::kBlocked && all_roomy(grid, at, at)) return true;
  const std::vector<ConvexArea> areas = grid.outline().turning(at, from_rad, to_rad);
  return std::all_of(areas.begin(), areas.end(),
                     [&](const ConvexArea& area) { return clear(grid, area, avoid); });
}

double known_free_part(const PlanningGrid& grid, GridPoint a, GridPoint b) {
  const int samples =
      std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / kSampleCells)));
  const double part = known_part_of_circle(grid, a, b, samples);
  if (grid.outline().is_circle() || a == b) return part;
  const auto is_known = [&](double t) {
    return t <= 0 || clear(grid, grid.outline().along(a, between(a, b, t)), Avoid::kBlockedAndUnknown);
  };
  if (is_known(part)) return part;
  // What is swept only grows: the last sample before it touches something.
  int known = 0, unknown = static_cast<int>(std::lround(part * samples));
  while (unknown - known > 1) {
    const int middle = (known + unknown) / 2;
    (is_known(static_cast<double>(middle) / samples) ? known : unknown) = middle;
  }
  return static_cast<double>(known) / samples;
}

}  // namespace floornav
