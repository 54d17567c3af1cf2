#include "planner/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/clear_way.hpp"

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

/// For the lines of a curve; that before it is where the robot comes from.
bool has_room(const PlanningGrid& grid, GridPoint before, const std::vector<GridPoint>& points,
              GridPoint after, bool known) {
  const Avoid avoid = known ? Avoid::kBlockedAndUnknown : Avoid::kBlocked;
  const auto heading = [](GridPoint a, GridPoint b) { return std::atan2(b.y - a.y, b.x - a.x); };
  double heading_rad = heading(before, points.front());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const GridPoint a = points[i - 1], b = points[i];
    if (!line_clear(grid, a, b) || !turn_clear(grid, a, heading_rad, heading(a, b), avoid)) return false;
    if (known && known_free_part(grid, a, b) < 1.0) return false;
    heading_rad = heading(a, b);
  }
  return turn_clear(grid, points.back(), heading_rad, heading(points.back(), after), avoid);
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
      if (!has_room(grid, a, tried, c, known)) continue;
      curve = std::move(tried);
      break;
    }
    points.insert(points.end(), curve.begin(), curve.end());
  }
  points.push_back(corners.back());
  return points;
}

}  // namespace floornav
