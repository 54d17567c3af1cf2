#pragma once

#include <vector>

#include "planner/outline_search.hpp"
#include "planner/planning_grid.hpp"
#include "planner/search/grid_search.hpp"

namespace floornav {

/// The cheapest way over a planning grid for the robot that it was made for, whether its footprint is a
/// circle or a polygon.
class WaySearch {
 public:
  /// As AStar::search. `heading_rad`: that of a robot that is no circle.
  SearchOutcome search(const PlanningGrid& grid, GridCell start, double heading_rad, GridCell goal,
                       const Interrupt& interrupt, OnNoPath on_no_path);
  /// The shortest way, much quicker; false where none was found in a few milliseconds. Of a robot that is no
  /// circle: none.
  bool shortest(const PlanningGrid& grid, GridCell start, GridCell goal);

  /// Of the last search, to its goal. Replaces what `path` holds.
  void path(std::vector<GridCell>& path) const;
  /// Of the last search, after kNoPath: as AStar has it.
  [[nodiscard]] bool told_early() const { return !polygon_ && grid_search_.told_early(); }
  [[nodiscard]] bool on_goal_side(GridCell cell) { return grid_search_.on_goal_side(cell); }
  /// Of the last search, after kNoPath that was not told early: whether a way leads to the cell, and that
  /// way.
  [[nodiscard]] bool reached(GridCell cell) const;
  void path_to(GridCell cell, std::vector<GridCell>& path) const;
  /// Of the last search, after kNoPath: the outline cannot be turned to any free neighbour.
  [[nodiscard]] bool stuck_at_start() const { return polygon_ && outline_search_.expanded() == 0; }

 private:
  GridSearch grid_search_;
  OutlineSearch outline_search_;
  bool polygon_ = false;
  GridCell goal_;
};

}  // namespace floornav
