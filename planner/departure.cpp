#include "planner/departure.hpp"

#include <cmath>

#include "planner/clear_way.hpp"
#include "planner/way_out.hpp"

namespace floornav {
namespace {

double distance(GridPoint a, GridPoint b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// The corners of a way out, from cell to cell, without its ends.
std::vector<GridPoint> corners_of(const std::vector<GridCell>& way) {
  std::vector<GridPoint> corners;
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const GridCell a = way[i - 1], b = way[i], c = way[i + 1];
    if (b.x - a.x != c.x - b.x || b.y - a.y != c.y - b.y) corners.push_back(centre(b));
  }
  return corners;
}

/// Cuts a line of corners off after a length; false where it is shorter.
bool cut_off(std::vector<GridPoint>& corners, double length) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const GridPoint a = corners[i - 1], b = corners[i];
    const double piece = distance(a, b);
    if (piece < length) {
      length -= piece;
      continue;
    }
    const double t = length / piece;
    corners.resize(i);
    corners.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    return true;
  }
  return false;
}

bool known_free(const PlanningGrid& grid, const std::vector<GridPoint>& corners, double heading_rad) {
  if (!route_open(grid, {grid.origin(), corners, 0}, heading_rad)) return false;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (known_free_part(grid, corners[i - 1], corners[i]) < 1.0) return false;
  return true;
}

}  // namespace

std::optional<Departure> departure(const PlanningGrid& grid, GridPoint here, double heading_rad,
                                   double reach_m) {
  const GridCell cell = cell_at(here);
  Departure result{here, heading_rad, cell, heading_rad, {}, 0};
  if (grid.search_grid().contains(cell) && grid.passable(cell) &&
      fits(grid, here, heading_rad, Avoid::kBlocked))
    return result;
  const auto way = way_out(grid, cell, reach_m);
  if (!way) return std::nullopt;
  if (way->size() == 1) return result;
  result.first = corners_of(*way);
  result.from = way->back();
  result.way_out = result.first.size() + 1;
  return result;
}

std::optional<Departure> departure_from_route(const PlanningGrid& grid, const Departure& at_rest,
                                              const Route& route, double stopping, double off_path) {
  if (stopping < 1.0 || at_rest.way_out > 0) return std::nullopt;
  auto corners = corners_ahead(moved(route, grid.origin()), at_rest.here, off_path);
  if (!corners) return std::nullopt;
  corners->insert(corners->begin(), at_rest.here);
  if (!cut_off(*corners, stopping)) return std::nullopt;
  const GridCell end = cell_at(corners->back());
  if (!grid.search_grid().contains(end) || !grid.passable(end)) return std::nullopt;
  corners->back() = centre(end);
  if (!known_free(grid, *corners, at_rest.heading_rad)) return std::nullopt;
  Departure result = at_rest;
  const GridPoint before = (*corners)[corners->size() - 2];
  result.from = end;
  result.from_rad = std::atan2(corners->back().y - before.y, corners->back().x - before.x);
  result.first.assign(corners->begin() + 1, corners->end() - 1);
  result.committed = true;
  return result;
}

Route route_after(const PlanningGrid& grid, const Departure& departure, std::vector<GridPoint> corners) {
  if (departure.at_once()) return {grid.origin(), std::move(corners), 0};
  Route route{grid.origin(), {departure.here}, departure.way_out};
  route.corners.insert(route.corners.end(), departure.first.begin(), departure.first.end());
  route.corners.insert(route.corners.end(), corners.begin(), corners.end());
  return route;
}

}  // namespace floornav
