#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "planner/search/a_star.hpp"
#include "planner/search/bit_grid.hpp"

namespace floornav {

/// A* over jump points only (Harabor and Grastien, AAAI 2011; blocks of cells and pruned diagonals, ICAPS
/// 2014) on a grid of free and blocked cells of uniform cost, diagonals cutting no corner. Paths are as short
/// as those of AStar. Nothing is prepared for a start or a goal: the grid may change between searches.
class JumpPointSearch {
 public:
  explicit JumpPointSearch(std::shared_ptr<SearchCells> cells = std::make_shared<SearchCells>())
      : cells_(std::move(cells)) {}

  /// Searches from start to goal, both on the grid; a blocked one has no path. `interrupt` may be empty.
  SearchOutcome search(const BitGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt = {});

  /// Of the last search with these cells, after kFound: the cells from its start to its goal. Replaces what
  /// `path` holds.
  void path(std::vector<GridCell>& path) const;
  /// Of the last search: jump points expanded.
  [[nodiscard]] std::int64_t expanded() const { return expanded_; }

 private:
  /// The value of a jump point's cell is its place in `points_`.
  struct JumpPoint {
    GridCell cell;
    std::uint32_t cost;
    std::uint32_t parent;  ///< the jump point before: the way from it is first diagonal, then straight
    std::uint8_t to_scan;  ///< directions that a way through this cell may go on in
    std::uint8_t scanned;
  };
  struct Waiting {
    std::uint32_t priority;  ///< cost and lower bound of the rest
    std::uint32_t point;
    friend auto operator<=>(const Waiting&, const Waiting&) = default;
  };

  /// A place from which to scan, on the way from a jump point.
  struct From {
    GridCell cell;
    std::uint64_t cost;
    std::uint32_t point;
  };

  void expand(const Waiting& next);
  void scan(const From& from, std::size_t k);
  template <std::size_t k>
  void scan_straight(const From& from);
  template <std::size_t k>
  void scan_diagonal(From from);
  void reach(GridCell cell, std::uint8_t directions, std::uint64_t cost, std::uint32_t parent);
  [[nodiscard]] std::uint8_t directions_after(GridCell cell, std::size_t k) const;

  std::shared_ptr<SearchCells> cells_;
  const BitGrid* grid_ = nullptr;  ///< during a search
  std::vector<Waiting> open_;      ///< a heap: jumps are too long for buckets
  std::vector<JumpPoint> points_;
  GridCell goal_;
  std::uint32_t least_priority_ = 0;  ///< of the point being expanded
  bool found_ = false;                ///< the goal, at the least priority
  std::int64_t expanded_ = 0;
};

}  // namespace floornav
