#pragma once

#include <cstdint>
#include <vector>

#include "planner/planning_grid.hpp"
#include "planner/search/a_star.hpp"
#include "planner/search/bucket_queue.hpp"
#include "planner/search/goal_bounds.hpp"
#include "planner/search/search_cells.hpp"

namespace floornav {

/// A* for a robot that is no circle: over cells and the eight headings in which it may arrive there. On every
/// step and in every turn, the short way round, its outline overlaps nothing blocked. Where there is room for
/// any heading a cell is one state, elsewhere eight; outlines are looked at only where a step would be worth
/// taking. On a weighted grid its heuristic is that of GoalBounds too: no way of the outline is cheaper than
/// that of a point.
class OutlineSearch {
 public:
  /// From a cell, heading for `heading_rad`, to another, whatever the heading there. Throws
  /// std::invalid_argument for a grid more than 8191 cells wide.
  SearchOutcome search(const PlanningGrid& grid, GridCell start, double heading_rad, GridCell goal,
                       const Interrupt& interrupt = {});

  /// Of the last search: whether it settled the cell; after kNoPath, whether a way leads there.
  [[nodiscard]] bool reached(GridCell cell) const { return cell == start_ || best_state(cell) != kNone; }
  /// Of the last search: the least cost of a cell that it reached.
  [[nodiscard]] std::uint32_t cost_of(GridCell cell) const;
  /// Of the last search: the cells from its start to one that it reached. Replaces what `path` holds.
  void path_to(GridCell cell, std::vector<GridCell>& path) const;
  /// Of the last search: states expanded; none: the robot could not even turn to a neighbour.
  [[nodiscard]] std::int64_t expanded() const { return expanded_; }

 private:
  /// Bits of a state's tag: the step that led there, the heading of the state before, and what it is.
  static constexpr std::uint32_t kStep = 7, kHeadingBefore = 7 << 3, kSettled = 1 << 6, kFirst = 1 << 7;
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  struct State {
    GridCell cell;
    std::uint32_t heading;  ///< in eighths of a turn; 0 where there is room for any
    std::uint32_t cost;
  };

  void leave_start(GridCell start, double heading_rad);
  void expand(const State& state);
  void reach(const State& from, std::uint32_t k, std::uint32_t tag);
  [[nodiscard]] bool may_turn(GridCell cell, std::uint32_t from, std::uint32_t to) const;
  [[nodiscard]] bool may_step(GridCell cell, std::uint32_t k) const;
  [[nodiscard]] bool clear(const std::vector<RowSpan>& spans, GridCell cell) const;
  [[nodiscard]] std::uint32_t least_rest(GridCell cell);
  [[nodiscard]] std::uint32_t state_of(GridCell cell, std::uint32_t heading) const;
  [[nodiscard]] std::uint32_t best_state(GridCell cell) const;

  const PlanningGrid* grid_ = nullptr;
  GridCell start_, goal_;
  BucketQueue queue_;
  SearchCells states_;
  GoalBounds bounds_;
  bool bounded_ = false;
  std::int64_t expanded_ = 0;
};

}  // namespace floornav
