#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "planner/search/bucket_queue.hpp"
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

  /// Searches from start to goal, both on the grid. `interrupt` may be empty.
  SearchOutcome search(const SearchGrid& grid, GridCell start, GridCell goal,
                       const Interrupt& interrupt = {});

  /// Of the last search: the least cost of a cell that it settled, kUnreached of another. After kNoPath every
  /// cell that can be reached is settled.
  [[nodiscard]] std::uint32_t cost_of(GridCell cell) const;
  /// Of the last search: the cells from its start to a settled one, both included. Replaces what `path`
  /// holds.
  void path_to(GridCell cell, std::vector<GridCell>& path) const;
  /// Of the last search: cells expanded.
  [[nodiscard]] std::int64_t expanded() const { return expanded_; }

  static constexpr std::uint32_t kUnreached = 0xFFFFFFFF;

 private:
  /// What a search knows of a cell, valid where its number is the search's: nothing is cleared between
  /// searches.
  struct Node {
    std::uint32_t cost;
    std::uint32_t search : 28;
    std::uint32_t settled : 1;
    std::uint32_t from : 3;  ///< the step that led here
  };

  void prepare(const SearchGrid& grid);
  template <bool kWeighted>
  SearchOutcome run(const SearchGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt);

  BucketQueue queue_;
  std::vector<Node> nodes_;
  std::uint32_t number_ = 0;  ///< of the search
  std::int32_t width_ = 0;
  GridCell start_;
  std::int64_t expanded_ = 0;
};

}  // namespace floornav
