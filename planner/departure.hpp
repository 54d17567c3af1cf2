#pragma once

#include <optional>
#include <vector>

#include "planner/planning_grid.hpp"
#include "planner/route.hpp"

namespace floornav {

/// Where the search for a way begins, and how the robot comes there.
struct Departure {
  GridPoint here;          ///< the robot's place
  double heading_rad = 0;  ///< and heading
  GridCell from;           ///< where the search begins: `here`'s own cell, or the end of what is driven first
  double from_rad = 0;     ///< the heading there
  std::vector<GridPoint> first;  ///< corners between `here` and the centre of `from`
  std::size_t way_out = 0;       ///< that many lines at the begin lead out of where the robot does not fit

  /// Neither a way out nor a stretch of another route comes first.
  [[nodiscard]] bool at_once() const { return !committed && way_out == 0; }
  bool committed = false;  ///< the robot is too quick to leave its route before `from`
};

/// That of a robot that may stop and turn: its own cell, or where it does not fit there the end of its way
/// out (way_out), no longer than `reach_m`. Nothing where there is none.
std::optional<Departure> departure(const PlanningGrid& grid, GridPoint here, double heading_rad,
                                   double reach_m);

/// That of a robot which comes to rest only after `stopping` (cells) on its route: the place reached then.
/// Nothing where that stretch is not open and known to be free any more, or shorter than a cell.
std::optional<Departure> departure_from_route(const PlanningGrid& grid, const Departure& at_rest,
                                              const Route& route, double stopping, double off_path);

/// The route that begins with a departure and goes on with `corners`, the first of which is the centre of its
/// `from` (or the robot's own place, where nothing comes first).
Route route_after(const PlanningGrid& grid, const Departure& departure, std::vector<GridPoint> corners);

}  // namespace floornav
