#include "planner/route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/known_line.hpp"

namespace floornav {
namespace {

GridPoint centre(GridCell cell) {
  return {static_cast<double>(cell.x), static_cast<double>(cell.y)};
}

double distance_to_line(GridPoint p, GridPoint a, GridPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

}  // namespace

Route moved(const Route& route, CellIndex origin) {
  Route result{origin, route.corners};
  for (GridPoint& corner : result.corners) {
    corner.x += route.origin.ix - origin.ix;
    corner.y += route.origin.iy - origin.iy;
  }
  return result;
}

std::vector<GridPoint> shorten(const PlanningGrid& grid, const std::vector<GridCell>& path) {
  const SearchGrid& cells = grid.search_grid();
  std::vector<double> cost(path.size(), 0.0);      // from the path's start, step by step
  std::vector<std::size_t> known(path.size(), 0);  // cells of known free floor up to here
  for (std::size_t i = 0; i < path.size(); ++i) {
    known[i] = (i > 0 ? known[i - 1] : 0) + (grid.known_free(path[i]) ? 1 : 0);
    if (i > 0) cost[i] = cost[i - 1] + line_cost(cells, centre(path[i - 1]), centre(path[i]));
  }
  const auto may_join = [&](std::size_t from, std::size_t to) {
    constexpr double kRounding = 1.0 + 1e-3;
    const GridPoint a = centre(path[from]), b = centre(path[to]);
    const std::size_t known_cells = known[to] - known[from] + (grid.known_free(path[from]) ? 1 : 0);
    if (known_cells != 0 && known_cells != to - from + 1) return false;
    return line_open(cells, a, b) && line_cost(cells, a, b) <= (cost[to] - cost[from]) * kRounding &&
           (known_cells == 0 || known_free_part(grid, a, b) == 1.0);
  };

  std::vector<GridPoint> corners{centre(path.front())};
  std::size_t from = 0;
  for (std::size_t to = 2; to < path.size(); ++to) {
    if (may_join(from, to)) continue;
    from = to - 1;
    corners.push_back(centre(path[from]));
  }
  if (path.size() > 1) corners.push_back(centre(path.back()));
  return corners;
}

bool route_open(const SearchGrid& grid, const std::vector<GridPoint>& corners) {
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (!line_open(grid, corners[i - 1], corners[i])) return false;
  return true;
}

double route_cost(const SearchGrid& grid, const std::vector<GridPoint>& corners) {
  double cost = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) cost += line_cost(grid, corners[i - 1], corners[i]);
  return cost;
}

std::optional<std::vector<GridPoint>> corners_ahead(const std::vector<GridPoint>& corners, GridPoint here,
                                                    double reach) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t next = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double distance = distance_to_line(here, corners[i - 1], corners[i]);
    if (distance > nearest) continue;
    nearest = distance;
    next = i;
  }
  if (nearest > reach) return std::nullopt;
  return std::vector<GridPoint>(corners.begin() + static_cast<std::ptrdiff_t>(next), corners.end());
}

}  // namespace floornav
