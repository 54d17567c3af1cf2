#include "planner/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/known_line.hpp"

namespace floornav {
namespace {

constexpr double kLineOfArc_rad = std::numbers::pi / 18;
constexpr double kLeastTurn_rad = 0.5 * kLineOfArc_rad;
constexpr double kLeastCut_cells = 0.5;

GridPoint towards(GridPoint from, GridPoint to, double distance) {
  const double t = distance / std::hypot(to.x - from.x, to.y - from.y);
  return {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
}

/// The arc that leaves the lines before and after a corner `cut` short of it.
std::vector<GridPoint> arc(GridPoint before, GridPoint corner, GridPoint after, double cut, double turn_rad) {
  const GridPoint begin = towards(corner, before, cut), end = towards(corner, after, cut);
  const double radius = cut / std::tan(0.5 * std::abs(turn_rad));
  const double side = turn_rad > 0 ? 1.0 : -1.0;
  const double heading = std::atan2(corner.y - before.y, corner.x - before.x);
  const GridPoint middle{begin.x - side * radius * std::sin(heading),
                         begin.y + side * radius * std::cos(heading)};
  const int lines = static_cast<int>(std::ceil(std::abs(turn_rad) / kLineOfArc_rad));
  std::vector<GridPoint> points{begin};
  for (int i = 1; i < lines; ++i) {
    const double at = heading + turn_rad * i / lines;
    points.push_back({middle.x + side * radius * std::sin(at), middle.y - side * radius * std::cos(at)});
  }
  points.push_back(end);
  return points;
}

bool has_room(const PlanningGrid& grid, const std::vector<GridPoint>& points, bool known) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!line_open(grid.search_grid(), points[i - 1], points[i])) return false;
    if (known && known_free_part(grid, points[i - 1], points[i]) < 1.0) return false;
  }
  return true;
}

}  // namespace

std::vector<GridPoint> rounded(const PlanningGrid& grid, const std::vector<GridPoint>& corners,
                               std::size_t fixed, double radius) {
  if (corners.size() < 3) return corners;
  std::vector<GridPoint> points(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(fixed) + 1);
  for (std::size_t i = fixed + 1; i + 1 < corners.size(); ++i) {
    const GridPoint a = corners[i - 1], b = corners[i], c = corners[i + 1];
    const double turn_rad = std::remainder(
        std::atan2(c.y - b.y, c.x - b.x) - std::atan2(b.y - a.y, b.x - a.x), 2 * std::numbers::pi);
    const bool known = known_free_part(grid, a, b) == 1.0 && known_free_part(grid, b, c) == 1.0;
    const double most = 0.5 * std::min(std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - b.x, c.y - b.y));
    double cut = std::min(most, radius * std::tan(0.5 * std::abs(turn_rad)));
    std::vector<GridPoint> curve{b};
    for (; std::abs(turn_rad) >= kLeastTurn_rad && cut >= kLeastCut_cells; cut *= 0.5) {
      auto tried = arc(a, b, c, cut, turn_rad);
      if (!has_room(grid, tried, known)) continue;
      curve = std::move(tried);
      break;
    }
    points.insert(points.end(), curve.begin(), curve.end());
  }
  points.push_back(corners.back());
  return points;
}

}  // namespace floornav
