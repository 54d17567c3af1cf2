#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "planner/search/a_star.hpp"
#include "planner/search/bit_grid.hpp"

namespace floornav {

/// A* over jump points only (Harabor and Grastien, AAAI 2011; blocks of cells and pruned diagonals, ICAPS
/// 2014) on a grid of free and blocked cells of uniform cost, diagonals cutting no corner. Paths are as short
/// as those of AStar. Nothing is prepared beforehand: the grid may change between searches.
class JumpPointSearch {
 public:
  /// Searches from start to goal, both on the grid; a blocked one has no path. `interrupt` may be empty.
  SearchOutcome search(const BitGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt = {});

  /// Of the last search, after kFound: the cells from its start to its goal. Replaces what `path` holds.
  void path(std::vector<GridCell>& path) const;
  /// Of the last search: jump points expanded.
  [[nodiscard]] std::int64_t expanded() const { return expanded_; }

 private:
  /// A jump point, valid where its number is the search's.
  struct Node {
    std::uint32_t cost;
    std::uint32_t search;
    std::uint32_t
        parent;  ///< index of the jump point before: the way from it is first diagonal, then straight
    std::uint8_t to_scan;  ///< directions that a way through this cell may go on in
    std::uint8_t scanned;
  };

  struct Waiting {
    std::uint32_t priority;  ///< cost and lower bound of the rest
    std::uint32_t item;
    friend auto operator<=>(const Waiting&, const Waiting&) = default;
  };

  void prepare(const BitGrid& grid, GridCell start, GridCell goal);
  void scan_straight(GridCell from, std::size_t k, std::uint64_t cost, std::uint32_t parent);
  void scan_diagonal(GridCell from, std::size_t k, std::uint64_t cost, std::uint32_t parent);
  void reach(GridCell cell, std::uint8_t directions, std::uint64_t cost, std::uint32_t parent);
  [[nodiscard]] std::uint8_t directions_after(GridCell cell, std::size_t k) const;
  [[nodiscard]] std::uint32_t index(GridCell cell) const {
    return static_cast<std::uint32_t>(cell.y) * static_cast<std::uint32_t>(grid_->width()) +
           static_cast<std::uint32_t>(cell.x);
  }

  const BitGrid* grid_ = nullptr;  ///< during a search
  std::vector<Waiting> open_;      ///< a heap: jumps are too long for buckets
  std::vector<Node> nodes_;
  std::uint32_t number_ = 0;
  std::int32_t width_ = 0;
  GridCell start_;
  GridCell goal_;
  std::int64_t expanded_ = 0;
};

}  // namespace floornav
