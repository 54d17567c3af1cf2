#include "planner/search/a_star.hpp"

#include <algorithm>
#include <bit>

#include "planner/search/octile.hpp"

namespace floornav {

namespace {

/// A search waits for memory most of its time: what it will read of a cell and the rows beside it is asked
/// for ahead.
void fetch_soon(const SearchGrid& grid, const SearchCells::Cell* cells, std::size_t index) {
  const auto width = static_cast<std::size_t>(grid.width);
  const std::size_t below = index >= width ? index - width : index;
  const std::size_t above = index + width < grid.edges.size() ? index + width : index;
  for (const std::size_t place : {index, below, above}) {
    __builtin_prefetch(cells + place, 1);
    if (!grid.weights.empty()) __builtin_prefetch(grid.weights.data() + place);
  }
  __builtin_prefetch(grid.edges.data() + index);
}

}  // namespace

SearchOutcome AStar::search(const SearchGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt,
                            const BlockWeights* blocks, OnNoPath on_no_path) {
  cells_->begin(grid.width, grid.height, start, goal);
  grid_ = &grid;
  start_ = start;
  goal_ = goal;
  expanded_ = 0;
  told_by_blocks_ = false;
  goal_side_.forget();
  look_at_goal_side_ = on_no_path == OnNoPath::kTellEarly && grid.whole_squares;
  bounded_ = blocks != nullptr && !grid.weights.empty();
  if (bounded_) {
    bounds_.begin(*blocks, grid.steps, goal);
    if (!bounds_.reach(start, interrupt)) return SearchOutcome::kInterrupted;
    told_by_blocks_ = on_no_path == OnNoPath::kTellEarly && bounds_.shut_off(start);
    if (told_by_blocks_) return SearchOutcome::kNoPath;
  }
  // A step raises cost + heuristic by no more than twice its own cost.
  const std::uint32_t heaviest = grid.weights.empty() ? 0 : 255;
  queue_.reset((2 * SearchGrid::weighted(grid.steps.diagonal, heaviest, heaviest) >> kBucketBits) + 2);
  if (grid.weights.empty())
    return grid.whole_squares ? run<false, true>(interrupt) : run<false, false>(interrupt);
  return grid.whole_squares ? run<true, true>(interrupt) : run<true, false>(interrupt);
}

/// Buckets of the queue hold a range of priorities: those of the goal's that could still lead to a cheaper
/// way are looked at too before it counts as found.
template <bool kWeighted, bool kCanonical>
SearchOutcome AStar::run(const Interrupt& interrupt) {
  SearchCells::Cell* const cells = cells_->data();
  const CanonicalSteps<kWeighted> canonical(*grid_);
  const SearchCells::Cell& goal = cells[grid_->index(goal_)];
  cells[grid_->index(start_)] = {0, cells_->tag()};
  push(start_, 0);
  bool found = false;
  std::uint32_t item = 0;
  while (!(found && queue_.bucket_done()) && queue_.pop(item)) {
    const GridCell at = unpack(item);
    const std::size_t index = grid_->index(at);
    SearchCells::Cell& cell = cells[index];
    if ((cell.tag & kSettled) != 0) continue;
    const bool at_goal = at == goal_;
    if (found && !at_goal && cell.value + least_rest(at) >= goal.value) continue;
    cell.tag |= kSettled;
    found = found || at_goal;
    if ((++expanded_ & (kExpansionsBetweenInterrupts - 1)) == 0) {
      if (interrupt && interrupt()) return SearchOutcome::kInterrupted;
      if (look_at_goal_side_) look_at_goal_side();
      if (goal_side_.shut_in()) return SearchOutcome::kNoPath;
    }
    if (at_goal || cell.value > kMaxCost) continue;
    queue_.look_ahead([&](std::uint32_t next) { fetch_soon(*grid_, cells, grid_->index(unpack(next))); });
    expand<kWeighted, kCanonical>(canonical, at, index);
  }
  return found ? SearchOutcome::kFound : SearchOutcome::kNoPath;
}

void AStar::look_at_goal_side() {
  if (expanded_ == kExpansionsBetweenInterrupts) goal_side_.begin(*grid_, *cells_, goal_);
  goal_side_.gather(*grid_, *cells_, kExpansionsBetweenInterrupts / 4);
}

template <bool kWeighted, bool kCanonical>
void AStar::expand(const CanonicalSteps<kWeighted>& canonical, GridCell at, std::size_t index) {
  const SearchGrid& grid = *grid_;
  SearchCells::Cell* const cells = cells_->data();
  const SearchCells::Cell cell = cells[index];
  unsigned open = grid.edges[index];
  if (kCanonical && (cell.tag & kFrom) != 0) open = canonical.after(index, cell.tag & kFrom);
  for (; open != 0; open &= open - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(open));
    const GridCell to{at.x + kStepX[k], at.y + kStepY[k]};
    const std::size_t next = grid.index(to);
    const std::uint32_t base = (k & 1) != 0 ? grid.steps.diagonal : grid.steps.straight;
    const std::uint32_t cost =
        cell.value + (kWeighted ? SearchGrid::weighted(base, grid.weights[index], grid.weights[next]) : base);
    if (reach(cells[next], cost, 1U << k, kCanonical)) push(to, cost);
  }
}

/// Takes down a way to a cell; whether it is worth expanding the cell for it.
inline bool AStar::reach(SearchCells::Cell& cell, std::uint32_t cost, std::uint32_t from, bool canonical) {
  const std::uint32_t number = cells_->tag();
  if (cell.tag < number || cell.value > cost) {  // numbers only grow: it is another search's, or dearer
    cell = {cost, number | from};
    return true;
  }
  if (cell.value < cost || (cell.tag & from) != 0 || !canonical) return false;
  // One more way of the same cost: it may go on where the others need not.
  const bool waits = (cell.tag & kSettled) == 0;
  cell.tag = (cell.tag | from) & ~kSettled;
  return !waits;
}

inline std::uint32_t AStar::least_rest(GridCell cell) {
  const std::uint32_t length = octile(goal_.x - cell.x, goal_.y - cell.y, grid_->steps);
  return bounded_ ? std::max(length, bounds_(cell)) : length;
}

inline void AStar::push(GridCell cell, std::uint32_t cost) {
  queue_.push((cost + least_rest(cell)) >> kBucketBits, pack(cell));
}

std::uint32_t AStar::cost_of(GridCell cell) const {
  const SearchCells::Cell& c = (*cells_)[cell];
  return cells_->current(c) && (c.tag & kSettled) != 0 ? c.value : kUnreached;
}

void AStar::path_to(GridCell cell, std::vector<GridCell>& path) const {
  path.clear();
  while (cell != start_) {
    path.push_back(cell);
    const auto from = static_cast<std::size_t>(std::countr_zero((*cells_)[cell].tag & kFrom));
    cell = {cell.x - kStepX[from], cell.y - kStepY[from]};
  }
  path.push_back(start_);
  std::reverse(path.begin(), path.end());
}

}  // namespace floornav
