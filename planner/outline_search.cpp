#include "planner/outline_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/clear_way.hpp"
#include "planner/search/octile.hpp"

namespace floornav {
namespace {

constexpr std::int64_t kExpansionsBetweenInterrupts = 256;

double heading_of_step(std::uint32_t k) {
  return k * std::numbers::pi / 4;
}

}  // namespace

SearchOutcome OutlineSearch::search(const PlanningGrid& grid, GridCell start, double heading_rad,
                                    GridCell goal, const Interrupt& interrupt) {
  const SearchGrid& cells = grid.search_grid();
  states_.begin(8 * cells.width, cells.height, {8 * start.x, start.y}, {8 * goal.x, goal.y});
  grid_ = &grid;
  start_ = start;
  goal_ = goal;
  expanded_ = 0;
  // A step raises cost + heuristic by no more than twice its own cost.
  queue_.reset(2 * SearchGrid::weighted(cells.steps.diagonal, 255, 255) + 1);
  if (start == goal) return SearchOutcome::kFound;
  bounded_ = grid.aids().blocks != nullptr;
  if (bounded_) {
    bounds_.begin(*grid.aids().blocks, cells.steps, goal);
    if (!bounds_.reach(start, interrupt)) return SearchOutcome::kInterrupted;
  }
  queue_.push(least_rest(start), kNone);  // none of the states yet
  std::uint32_t item = 0;
  while (queue_.pop(item)) {
    if (item == kNone) {
      leave_start(start, heading_rad);
      continue;
    }
    SearchCells::Cell& known = states_.data()[item];
    if ((known.tag & kSettled) != 0) continue;
    known.tag |= kSettled;
    const std::uint32_t index = item / 8, width = static_cast<std::uint32_t>(cells.width);
    const GridCell cell{static_cast<std::int32_t>(index % width), static_cast<std::int32_t>(index / width)};
    if (cell == goal) return SearchOutcome::kFound;
    if ((++expanded_ & (kExpansionsBetweenInterrupts - 1)) == 0 && interrupt && interrupt())
      return SearchOutcome::kInterrupted;
    expand({cell, item % 8, known.value});
  }
  return SearchOutcome::kNoPath;
}

void OutlineSearch::leave_start(GridCell start, double heading_rad) {
  const GridPoint centre{static_cast<double>(start.x), static_cast<double>(start.y)};
  for (std::uint32_t k = 0; k < 8; ++k)
    if (turn_clear(*grid_, centre, heading_rad, heading_of_step(k), Avoid::kBlocked))
      reach({start, k, 0}, k, kFirst);
}

void OutlineSearch::expand(const State& state) {
  constexpr std::uint32_t kFarthest = 0xF0000000;
  if (state.cost > kFarthest) return;
  for (std::uint32_t k = 0; k < 8; ++k) reach(state, k, state.heading << 3);
}

/// Takes a step, if it is open and worth it; the outline is looked at last.
void OutlineSearch::reach(const State& from, std::uint32_t k, std::uint32_t tag) {
  const SearchGrid& cells = grid_->search_grid();
  const std::size_t index = cells.index(from.cell);
  if ((cells.edges[index] >> k & 1) == 0) return;
  const GridCell to{from.cell.x + kStepX[k], from.cell.y + kStepY[k]};
  const auto weight = [&](std::size_t i) {
    return cells.weights.empty() ? 0U : std::uint32_t{cells.weights[i]};
  };
  const std::uint32_t base = (k & 1) != 0 ? cells.steps.diagonal : cells.steps.straight;
  const std::uint32_t cost = from.cost + SearchGrid::weighted(base, weight(index), weight(cells.index(to)));
  const std::uint32_t state = state_of(to, k);
  SearchCells::Cell& known = states_.data()[state];
  if (states_.current(known) && known.value <= cost) return;
  if (!may_turn(from.cell, from.heading, k) || !may_step(from.cell, k)) return;
  known = {cost, states_.tag() | tag | k};
  queue_.push(cost + least_rest(to), state);
}

std::uint32_t OutlineSearch::least_rest(GridCell cell) {
  const std::uint32_t length = octile(goal_.x - cell.x, goal_.y - cell.y, grid_->search_grid().steps);
  return bounded_ ? std::max(length, bounds_(cell)) : length;
}

/// Half a turn may go either way: both must be open.
bool OutlineSearch::may_turn(GridCell cell, std::uint32_t from, std::uint32_t to) const {
  if (from == to || grid_->roomy(cell)) return true;
  const std::uint32_t left = (to - from) & 7U, right = (from - to) & 7U;
  const auto turns = [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i)
      if (!clear(grid_->outline().turn((first + i) & 7U), cell)) return false;
    return true;
  };
  return (left > 4 || turns(from, left)) && (right > 4 || turns(to, right));
}

bool OutlineSearch::may_step(GridCell cell, std::uint32_t k) const {
  const GridCell to{cell.x + kStepX[k], cell.y + kStepY[k]};
  return (grid_->roomy(cell) && grid_->roomy(to)) || clear(grid_->outline().step(k), cell);
}

bool OutlineSearch::clear(const std::vector<RowSpan>& spans, GridCell cell) const {
  return std::all_of(spans.begin(), spans.end(),
                     [&](const RowSpan& span) { return grid_->clear(span, cell, Avoid::kBlocked); });
}

std::uint32_t OutlineSearch::state_of(GridCell cell, std::uint32_t heading) const {
  return static_cast<std::uint32_t>(grid_->search_grid().index(cell)) * 8 +
         (grid_->roomy(cell) ? 0 : heading);
}

/// Of the states of a cell, the cheapest one settled.
std::uint32_t OutlineSearch::best_state(GridCell cell) const {
  std::uint32_t best = kNone, least = kNone;
  for (std::uint32_t heading = 0; heading < 8; ++heading) {
    const GridCell place{8 * cell.x + static_cast<std::int32_t>(heading), cell.y};
    const SearchCells::Cell& known = states_[place];
    if (!states_.current(known) || (known.tag & kSettled) == 0 || known.value >= least) continue;
    least = known.value;
    best = static_cast<std::uint32_t>(states_.index(place));
  }
  return best;
}

std::uint32_t OutlineSearch::cost_of(GridCell cell) const {
  if (cell == start_) return 0;
  const std::uint32_t state = best_state(cell);
  return state == kNone ? AStar::kUnreached
                        : states_[{static_cast<std::int32_t>(state % 8) + 8 * cell.x, cell.y}].value;
}

void OutlineSearch::path_to(GridCell cell, std::vector<GridCell>& path) const {
  path.clear();
  if (cell != start_) {
    std::uint32_t heading = best_state(cell) % 8;
    for (;;) {
      path.push_back(cell);
      const std::uint32_t tag = states_[{8 * cell.x + static_cast<std::int32_t>(heading), cell.y}].tag;
      const std::uint32_t k = tag & kStep;
      cell = {cell.x - kStepX[k], cell.y - kStepY[k]};
      if ((tag & kFirst) != 0) break;
      heading = (tag & kHeadingBefore) >> 3;
    }
  }
  path.push_back(start_);
  std::reverse(path.begin(), path.end());
}

}  // namespace floornav
