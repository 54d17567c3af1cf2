#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "planner/search/bucket_queue.hpp"
#include "planner/search/search_cells.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

enum class SearchOutcome : std::uint8_t { kFound, kNoPath, kInterrupted };

/// Asked now and then during a search whether to give up: a deadline, or a cancel.
using Interrupt = std::function<bool()>;

/// A* with the octile distance as heuristic: the cheapest way over a SearchGrid. The same query gives the
/// same answer always; after the first queries on a grid of some size none allocates, and none touches cells
/// that it does not reach.
class AStar {
 public:
  static constexpr std::int64_t kExpansionsBetweenInterrupts = 1024;

  explicit AStar(std::shared_ptr<SearchCells> cells = std::make_shared<SearchCells>())
      : cells_(std::move(cells)) {}

  /// Searches from start to goal, both on the grid. `interrupt` may be empty.
  SearchOutcome search(const SearchGrid& grid, GridCell start, GridCell goal,
                       const Interrupt& interrupt = {});

  /// Of the last search with these cells: the least cost of one that it settled, kUnreached of another. After
  /// kNoPath every cell that can be reached is settled.
  [[nodiscard]] std::uint32_t cost_of(GridCell cell) const;
  /// Of the last search: the cells from its start to a settled one, both included. Replaces what `path`
  /// holds.
  void path_to(GridCell cell, std::vector<GridCell>& path) const;
  /// Of the last search: cells expanded.
  [[nodiscard]] std::int64_t expanded() const { return expanded_; }

  static constexpr std::uint32_t kUnreached = 0xFFFFFFFF;

 private:
  /// A cell's value is its cost so far. In its tag: the steps that lead to it at that cost, a bit each, and
  /// whether it was expanded since the last of them came.
  static constexpr std::uint32_t kFrom = 0xFF;
  static constexpr std::uint32_t kSettled = 0x100;

  template <bool kWeighted, bool kCanonical>
  SearchOutcome run(const SearchGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt);

  BucketQueue queue_;
  std::shared_ptr<SearchCells> cells_;
  GridCell start_;
  std::int64_t expanded_ = 0;
};

}  // namespace floornav
