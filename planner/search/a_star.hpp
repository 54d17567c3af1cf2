#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "planner/search/block_weights.hpp"
#include "planner/search/bucket_queue.hpp"
#include "planner/search/canonical_steps.hpp"
#include "planner/search/goal_bounds.hpp"
#include "planner/search/goal_side.hpp"
#include "planner/search/search_cells.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

enum class SearchOutcome : std::uint8_t { kFound, kNoPath, kInterrupted };

/// What a search does where the goal cannot be reached: settle all cells that can be, or tell so as soon as
/// it is known what the goal's side is.
enum class OnNoPath : std::uint8_t { kSettleAll, kTellEarly };

/// Asked now and then during a search whether to give up: a deadline, or a cancel.
using Interrupt = std::function<bool()>;

/// A* with the octile distance as heuristic, on weighted grids that of GoalBounds too: the cheapest way over
/// a SearchGrid. The same query gives the same answer always; after the first queries on a grid of some size
/// none allocates, and none touches cells that it does not reach.
class AStar {
 public:
  static constexpr std::int64_t kExpansionsBetweenInterrupts = 1024;

  explicit AStar(std::shared_ptr<SearchCells> cells = std::make_shared<SearchCells>())
      : cells_(std::move(cells)) {}

  /// Searches from start to goal, both on the grid. `interrupt` may be empty. `blocks`, where given, are
  /// those of the grid, with which a search on a weighted one expands fewer cells.
  SearchOutcome search(const SearchGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt = {},
                       const BlockWeights* blocks = nullptr, OnNoPath on_no_path = OnNoPath::kSettleAll);

  /// Of the last search with these cells: the least cost of one that it settled, kUnreached of another. After
  /// kNoPath every cell that can be reached is settled, unless that was told early.
  [[nodiscard]] std::uint32_t cost_of(GridCell cell) const;
  /// Of the last search: the cells from its start to a settled one, both included. Replaces what `path`
  /// holds.
  void path_to(GridCell cell, std::vector<GridCell>& path) const;
  /// Of the last search: cells expanded.
  [[nodiscard]] std::int64_t expanded() const { return expanded_; }

  /// Of the last search, after kNoPath: not all that can be reached was settled.
  [[nodiscard]] bool told_early() const { return told_by_blocks_ || goal_side_.shut_in(); }
  /// And then: the cell is on the goal's side, from which no way leads to the start.
  [[nodiscard]] bool on_goal_side(GridCell cell) {
    return told_by_blocks_ ? !bounds_.shut_off(cell) : goal_side_.contains(*cells_, cell);
  }

  static constexpr std::uint32_t kUnreached = 0xFFFFFFFF;

 private:
  /// A cell's value is its cost so far. In its tag: the steps that lead to it at that cost, a bit each, and
  /// whether it was expanded since the last of them came.
  static constexpr std::uint32_t kFrom = 0xFF;
  static constexpr std::uint32_t kSettled = 0x100;
  static constexpr std::uint32_t kMaxCost = kUnreached / 2;  ///< dearer cells are not expanded: sums fit
  static constexpr unsigned kBucketBits = 6;                 ///< priorities of a bucket, as a power of two

  template <bool kWeighted, bool kCanonical>
  SearchOutcome run(const Interrupt& interrupt);
  template <bool kWeighted, bool kCanonical>
  void expand(const CanonicalSteps<kWeighted>& canonical, GridCell at, std::size_t index);
  [[nodiscard]] bool reach(SearchCells::Cell& cell, std::uint32_t cost, std::uint32_t from, bool canonical);
  [[nodiscard]] std::uint32_t least_rest(GridCell cell);
  void push(GridCell cell, std::uint32_t cost);
  void look_at_goal_side();

  BucketQueue queue_;
  std::shared_ptr<SearchCells> cells_;
  GoalBounds bounds_;
  const SearchGrid* grid_ = nullptr;  ///< during a search
  GridCell start_, goal_;
  GoalSide goal_side_;
  bool bounded_ = false;  ///< by bounds_ too
  bool look_at_goal_side_ = false;
  bool told_by_blocks_ = false;
  std::int64_t expanded_ = 0;
};

}  // namespace floornav
