#include "planner/search/a_star.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "planner/search/canonical_steps.hpp"
#include "planner/search/octile.hpp"

namespace floornav {

namespace {

/// A search waits for memory most of its time: what it will read of a cell and the rows beside it is asked
/// for ahead.
void fetch_soon(const SearchGrid& grid, const SearchCells::Cell* cells, std::size_t index) {
  const auto width = static_cast<std::size_t>(grid.width);
  __builtin_prefetch(cells + index, 1);
  if (index >= width) __builtin_prefetch(cells + index - width, 1);
  if (index + width < grid.edges.size()) __builtin_prefetch(cells + index + width, 1);
  __builtin_prefetch(grid.edges.data() + index);
}

}  // namespace

SearchOutcome AStar::search(const SearchGrid& grid, GridCell start, GridCell goal,
                            const Interrupt& interrupt) {
  cells_->begin(grid.width, grid.height, start, goal);
  start_ = start;
  expanded_ = 0;
  const std::uint32_t heaviest = grid.weights.empty() ? 0 : 255;
  // A step raises cost + heuristic by at most its own cost and one diagonal step more.
  queue_.reset(SearchGrid::weighted(grid.steps.diagonal, heaviest, heaviest) + grid.steps.diagonal + 1);
  if (grid.weights.empty())
    return grid.whole_squares ? run<false, true>(grid, start, goal, interrupt)
                              : run<false, false>(grid, start, goal, interrupt);
  return grid.whole_squares ? run<true, true>(grid, start, goal, interrupt)
                            : run<true, false>(grid, start, goal, interrupt);
}

template <bool kWeighted, bool kCanonical>
SearchOutcome AStar::run(const SearchGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt) {
  const StepCosts steps = grid.steps;
  const std::uint8_t* const edges = grid.edges.data();
  const std::uint8_t* const weights = grid.weights.data();
  const CanonicalSteps<kWeighted> canonical(grid);
  SearchCells::Cell* const cells = cells_->data();
  const std::uint32_t number = cells_->tag();
  const std::size_t goal_index = grid.index(goal);
  // Beyond this a sum of costs could overflow: such cells are not expanded.
  const std::uint32_t max_cost = kUnreached - 32 * steps.diagonal - octile(grid.width, grid.height, steps);
  std::array<std::ptrdiff_t, 8> offsets;
  for (std::size_t k = 0; k < 8; ++k)
    offsets[k] = static_cast<std::ptrdiff_t>(kStepY[k]) * grid.width + kStepX[k];

  cells[grid.index(start)] = {0, number};
  queue_.push(octile(goal.x - start.x, goal.y - start.y, steps), pack(start));
  std::uint32_t item = 0;
  while (queue_.pop(item)) {
    const GridCell at = unpack(item);
    const std::size_t index = grid.index(at);
    SearchCells::Cell& cell = cells[index];
    if ((cell.tag & kSettled) != 0) continue;
    cell.tag |= kSettled;
    if (index == goal_index) return SearchOutcome::kFound;
    if ((++expanded_ & (kExpansionsBetweenInterrupts - 1)) == 0 && interrupt && interrupt())
      return SearchOutcome::kInterrupted;
    if (cell.value > max_cost) continue;
    fetch_soon(grid, cells, grid.index(unpack(queue_.next_or(item))));
    unsigned open = edges[index];
    if (kCanonical && (cell.tag & kFrom) != 0) open = canonical.after(index, cell.tag & kFrom);
    for (; open != 0; open &= open - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(open));
      const std::size_t next = index + static_cast<std::size_t>(offsets[k]);
      const std::uint32_t base = (k & 1) != 0 ? steps.diagonal : steps.straight;
      const std::uint32_t cost =
          cell.value + (kWeighted ? SearchGrid::weighted(base, weights[index], weights[next]) : base);
      const std::uint32_t from = 1U << k;
      SearchCells::Cell& neighbour = cells[next];
      if (neighbour.tag >= number) {  // numbers only grow: it is this search's
        if (neighbour.value < cost || (neighbour.value == cost && (neighbour.tag & from) != 0)) continue;
        if (neighbour.value == cost) {
          // One more way of the same cost: it may go on where the others need not.
          const bool waits = (neighbour.tag & kSettled) == 0;
          if (!kCanonical) continue;
          neighbour.tag = (neighbour.tag | from) & ~kSettled;
          if (waits) continue;
        } else {
          neighbour = {cost, number | from};
        }
      } else {
        neighbour = {cost, number | from};
      }
      const GridCell to{at.x + kStepX[k], at.y + kStepY[k]};
      queue_.push(cost + octile(goal.x - to.x, goal.y - to.y, steps), pack(to));
    }
  }
  return SearchOutcome::kNoPath;
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
