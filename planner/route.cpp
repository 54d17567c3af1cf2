#include "planner/route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/clear_way.hpp"

namespace floornav {
namespace {

double distance_to_line(GridPoint p, GridPoint a, GridPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

}  // namespace

Route moved(const Route& route, CellIndex origin) {
  Route result{origin, route.corners, route.way_out};
  for (GridPoint& corner : result.corners) {
    corner.x += route.origin.ix - origin.ix;
    corner.y += route.origin.iy - origin.iy;
  }
  return result;
}

bool route_open(const PlanningGrid& grid, const Route& route, double heading_rad) {
  for (std::size_t i = route.way_out + 1; i < route.corners.size(); ++i) {
    const GridPoint a = route.corners[i - 1], b = route.corners[i];
    if (!line_clear(grid, a, b)) return false;
    if (a == b) continue;
    const double next_rad = heading_between(a, b);
    if (!turn_clear(grid, a, heading_rad, next_rad, Avoid::kBlocked)) return false;
    heading_rad = next_rad;
  }
  return true;
}

double route_cost(const SearchGrid& grid, const Route& route, double heading_rad, double turn_cost) {
  double cost = 0;
  for (std::size_t i = route.way_out + 1; i < route.corners.size(); ++i) {
    const GridPoint a = route.corners[i - 1], b = route.corners[i];
    if (a == b) continue;
    const double next_rad = std::atan2(b.y - a.y, b.x - a.x);
    cost += line_cost(grid, a, b) +
            turn_cost * std::abs(std::remainder(next_rad - heading_rad, 2 * std::numbers::pi));
    heading_rad = next_rad;
  }
  return cost;
}

std::optional<std::vector<GridPoint>> corners_ahead(const Route& route, GridPoint here, double reach) {
  const std::vector<GridPoint>& corners = route.corners;
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t next = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double distance = distance_to_line(here, corners[i - 1], corners[i]);
    if (distance > nearest) continue;
    nearest = distance;
    next = std::max(i, route.way_out);
  }
  if (nearest > reach) return std::nullopt;
  return std::vector<GridPoint>(corners.begin() + static_cast<std::ptrdiff_t>(next), corners.end());
}

}  // namespace floornav
