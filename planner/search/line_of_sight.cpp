#include "planner/search/line_of_sight.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr unsigned kEast = 1U << 0;
constexpr unsigned kNorthEast = 1U << 1;
constexpr unsigned kNorth = 1U << 2;
constexpr unsigned kNorthWest = 1U << 3;

bool edge_open(const SearchGrid& grid, GridCell cell, unsigned edge) {
  return grid.contains(cell) && (grid.edges[grid.index(cell)] & edge) != 0;
}

/// The square between the centres of (x, y) and (x + 1, y + 1).
bool square_open(const SearchGrid& grid, GridCell low) {
  const GridCell right{low.x + 1, low.y}, above{low.x, low.y + 1};
  return edge_open(grid, low, kEast) && edge_open(grid, low, kNorth) && edge_open(grid, low, kNorthEast) &&
         edge_open(grid, right, kNorth) && edge_open(grid, right, kNorthWest) &&
         edge_open(grid, above, kEast);
}

bool is_centre(GridPoint p) {
  return p.x == std::floor(p.x) && p.y == std::floor(p.y);
}

/// From centre to centre, with exact arithmetic. Axes are swapped so that the line climbs no more than 45
/// degrees.
bool centres_open(const SearchGrid& grid, GridCell a, GridCell b) {
  const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  if (steep) std::swap(a.x, a.y), std::swap(b.x, b.y);
  if (a.x > b.x) std::swap(a, b);
  const std::int64_t run = b.x - a.x, rise = b.y - a.y;
  const auto cell = [&](std::int64_t along, std::int64_t across) {
    const auto major = static_cast<std::int32_t>(a.x + along), minor = static_cast<std::int32_t>(across);
    return steep ? GridCell{minor, major} : GridCell{major, minor};
  };
  const auto floor_div = [&](std::int64_t n) { return n >= 0 ? n / run : -((-n + run - 1) / run); };
  for (std::int64_t i = 0; i < run; ++i) {
    const std::int64_t lowest = std::min(i * rise, (i + 1) * rise),
                       highest = std::max(i * rise, (i + 1) * rise);
    const std::int64_t low = a.y + floor_div(lowest), high = a.y - floor_div(-highest);
    if (low == high && !edge_open(grid, cell(i, low), steep ? kNorth : kEast)) return false;
    for (std::int64_t j = low; j < high; ++j)
      if (!square_open(grid, cell(i, j))) return false;
  }
  return true;
}

/// Between any points: every square that the line passes through must be open.
bool squares_open(const SearchGrid& grid, GridPoint a, GridPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  double next_x =
      dx > 0 ? std::floor(a.x) + 1 : std::ceil(a.x) - 1;  // lines between squares, as they are crossed
  double next_y = dy > 0 ? std::floor(a.y) + 1 : std::ceil(a.y) - 1;
  double t = 0;
  while (t < 1) {
    const double t_x = dx != 0 ? (next_x - a.x) / dx : 2.0;
    const double t_y = dy != 0 ? (next_y - a.y) / dy : 2.0;
    const double end = std::min({t_x, t_y, 1.0});
    const double middle = 0.5 * (t + end);
    const GridCell low{static_cast<std::int32_t>(std::floor(a.x + middle * dx)),
                       static_cast<std::int32_t>(std::floor(a.y + middle * dy))};
    if (!square_open(grid, low)) return false;
    t = end;
    if (t_x <= end) next_x += dx > 0 ? 1 : -1;
    if (t_y <= end) next_y += dy > 0 ? 1 : -1;
  }
  return true;
}

}  // namespace

bool line_open(const SearchGrid& grid, GridPoint a, GridPoint b) {
  if (!grid.contains(cell_at(a)) || !grid.contains(cell_at(b))) return false;
  return is_centre(a) && is_centre(b) ? centres_open(grid, cell_at(a), cell_at(b)) : squares_open(grid, a, b);
}

double line_cost(const SearchGrid& grid, GridPoint a, GridPoint b) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const int samples = static_cast<int>(std::ceil(length)) + 1;
  double weights = 0;
  for (int i = 0; i < samples; ++i) {
    const double t = (i + 0.5) / samples;
    const GridCell cell = cell_at({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    weights += grid.weights.empty() ? 0.0 : grid.weights[grid.index(cell)];
  }
  return length * (1.0 + weights / samples / SearchGrid::kWeightUnit);
}

}  // namespace floornav
