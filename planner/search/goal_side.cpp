#include "planner/search/goal_side.hpp"

#include <bit>

namespace floornav {

void GoalSide::begin(const SearchGrid& grid, SearchCells& cells, GridCell goal) {
  forget();
  const std::size_t index = grid.index(goal);
  if (cells.current(cells.data()[index])) {
    state_ = State::kMet;
    return;
  }
  cells.data()[index].tag = cells.mark();
  open_.push_back(static_cast<std::uint32_t>(index));
}

void GoalSide::gather(const SearchGrid& grid, SearchCells& cells, std::size_t count) {
  for (; count > 0 && state_ == State::kUnknown && !open_.empty(); --count) {
    const std::uint32_t index = open_.back();
    open_.pop_back();
    for (unsigned steps = grid.edges[index]; steps != 0; steps &= steps - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(steps));
      const std::size_t next =
          index + static_cast<std::size_t>(std::ptrdiff_t{kStepY[k]} * grid.width + kStepX[k]);
      SearchCells::Cell& cell = cells.data()[next];
      if (cells.current(cell)) {
        state_ = State::kMet;
        return;
      }
      if (cell.tag == cells.mark()) continue;
      cell.tag = cells.mark();
      open_.push_back(static_cast<std::uint32_t>(next));
    }
  }
  if (state_ == State::kUnknown && open_.empty()) state_ = State::kShutIn;
}

}  // namespace floornav
