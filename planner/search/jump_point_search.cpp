#include "planner/search/jump_point_search.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <functional>
#include <limits>

#include "planner/search/octile.hpp"

namespace floornav {
namespace {

constexpr std::int64_t kPointsBetweenInterrupts = 128;
constexpr StepCosts kSteps = kExactSteps;
constexpr std::int32_t kNone = -1;

/// The first place after `from` on a line where a scan stops.
std::int32_t next_stop(const std::uint64_t* stops, std::int32_t from) {
  const auto first = static_cast<std::size_t>(from + 1) + 1;
  std::size_t w = first / 64;
  std::uint64_t found = stops[w] & ~0ULL << (first % 64);
  while (found == 0) found = stops[++w];
  return static_cast<std::int32_t>(w * 64) + std::countr_zero(found) - 1;
}

/// And the last one before it. A bit ahead of a cell's own stands for the blocked cell around the grid.
std::int32_t previous_stop(const std::uint64_t* stops, std::int32_t from) {
  const auto last = static_cast<std::size_t>(from + 1) - 1;
  std::size_t w = last / 64;
  std::uint64_t found = stops[w] & ~0ULL >> (63 - last % 64);
  while (found == 0) found = stops[--w];
  return static_cast<std::int32_t>(w * 64) + 63 - std::countl_zero(found) - 1;
}

/// The eighth of all directions in which another cell lies, and both its sides.
unsigned directions_towards(GridCell from, GridCell to) {
  const bool right = to.x >= from.x, above = to.y >= from.y;
  if (above) return right ? 0b00000111 : 0b00011100;
  return right ? 0b11000001 : 0b01110000;
}

}  // namespace

SearchOutcome JumpPointSearch::search(const BitGrid& grid, GridCell start, GridCell goal,
                                      const Interrupt& interrupt) {
  cells_->begin(grid.width(), grid.height(), start, goal);
  grid_ = &grid;
  goal_ = goal;
  expanded_ = 0;
  found_ = false;
  open_.clear();
  points_.clear();
  if (!grid.free(start) || !grid.free(goal)) return SearchOutcome::kNoPath;
  reach(start, 0xFF, 0, 0);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const Waiting next = open_.back();
    open_.pop_back();
    if (points_[next.point].to_scan == 0) continue;
    if (points_[next.point].cell == goal) return SearchOutcome::kFound;
    if ((++expanded_ & (kPointsBetweenInterrupts - 1)) == 0 && interrupt && interrupt())
      return SearchOutcome::kInterrupted;
    expand(next);
    if (found_) return SearchOutcome::kFound;
  }
  return SearchOutcome::kNoPath;
}

/// Towards the goal first: a way to it that costs no more than what all others must is as short as any.
void JumpPointSearch::expand(const Waiting& next) {
  JumpPoint& p = points_[next.point];
  const From from{p.cell, p.cost, next.point};
  const unsigned directions = p.to_scan;
  least_priority_ = next.priority;
  p.scanned |= p.to_scan;
  p.to_scan = 0;
  const unsigned towards = directions_towards(from.cell, goal_) & directions;
  for (unsigned first : {towards, directions & ~towards})
    for (; first != 0 && !found_; first &= first - 1)
      scan(from, static_cast<std::size_t>(std::countr_zero(first)));
}

void JumpPointSearch::scan(const From& from, std::size_t k) {
  switch (k) {
    case 0:
      return scan_straight<0>(from);
    case 1:
      return scan_diagonal<1>(from);
    case 2:
      return scan_straight<2>(from);
    case 3:
      return scan_diagonal<3>(from);
    case 4:
      return scan_straight<4>(from);
    case 5:
      return scan_diagonal<5>(from);
    case 6:
      return scan_straight<6>(from);
    default:
      return scan_diagonal<7>(from);
  }
}

/// Goes on straight to the next jump point, or to the goal, if there is one before a blocked cell.
template <std::size_t k>
void JumpPointSearch::scan_straight(const From& from) {
  constexpr bool kAlongRows = k == 0 || k == 4, kForward = k < 4;
  const BitGrid::Lines& lines = kAlongRows ? grid_->rows() : grid_->columns();
  const std::int32_t index = kAlongRows ? from.cell.y : from.cell.x;
  const std::int32_t at = kAlongRows ? from.cell.x : from.cell.y;
  const std::uint64_t* const stops = lines.stops[kForward ? 0 : 1].data() + lines.line(index);
  std::int32_t to = kForward ? next_stop(stops, at) : previous_stop(stops, at);
  const std::int32_t goal = kAlongRows ? goal_.x : goal_.y;
  const bool passed = (kAlongRows ? goal_.y : goal_.x) == index &&
                      (kForward ? goal > at && goal < to : goal < at && goal > to);
  if (passed)
    to = goal;
  else if (!lines.bit(index, to))
    return;
  const GridCell cell = kAlongRows ? GridCell{to, index} : GridCell{index, to};
  const auto steps = static_cast<std::uint32_t>(kForward ? to - at : at - to);
  reach(cell, directions_after(cell, k), from.cost + std::uint64_t{kSteps.straight} * steps, from.point);
}

/// Goes on diagonally as far as the corner rule allows, and from each cell straight to both sides.
template <std::size_t k>
void JumpPointSearch::scan_diagonal(From from) {
  const std::size_t words = grid_->rows().words;
  const std::uint64_t* row = grid_->rows().bits.data() + grid_->rows().line(from.cell.y);
  const auto free = [](const std::uint64_t* cells, std::int32_t x) {
    const auto place = static_cast<std::size_t>(x + 1);
    return cells[place / 64] >> (place % 64) & 1;
  };
  while (!found_) {
    const std::uint64_t* const next = kStepY[k] > 0 ? row + words : row - words;
    const std::int32_t x = from.cell.x + kStepX[k];
    if ((free(row, x) & free(next, from.cell.x) & free(next, x)) == 0) return;
    row = next;
    from.cell = {x, from.cell.y + kStepY[k]};
    from.cost += kSteps.diagonal;
    if (from.cell == goal_) reach(from.cell, 0xFF, from.cost, from.point);
    scan_straight<k - 1>(from);
    scan_straight<(k + 1) % 8>(from);
  }
}

/// Where a shortest way that comes straight to a cell may go on: straight, and around a corner that it has
/// just passed.
inline std::uint8_t JumpPointSearch::directions_after(GridCell cell, std::size_t k) const {
  unsigned directions = 1U << k;
  for (const std::size_t turn : {std::size_t{1}, std::size_t{7}}) {
    const std::size_t between = (k + turn) % 8, side = (k + 2 * turn) % 8;
    const GridCell beside{cell.x + kStepX[side], cell.y + kStepY[side]};
    const GridCell before{beside.x - kStepX[k], beside.y - kStepY[k]};
    if (grid_->free(beside) && !grid_->free(before)) directions |= 1U << between | 1U << side;
  }
  return static_cast<std::uint8_t>(directions);
}

void JumpPointSearch::reach(GridCell cell, std::uint8_t directions, std::uint64_t cost,
                            std::uint32_t parent) {
  const std::uint64_t priority = cost + octile(goal_.x - cell.x, goal_.y - cell.y, kSteps);
  found_ = found_ || (cell == goal_ && priority <= least_priority_);
  if (priority > std::numeric_limits<std::uint32_t>::max()) return;  // as AStar, which expands no such cell
  SearchCells::Cell& known = cells_->data()[cells_->index(cell)];
  if (!cells_->current(known)) {
    known = {static_cast<std::uint32_t>(points_.size()), cells_->tag()};
    points_.push_back({cell, static_cast<std::uint32_t>(cost), parent, directions, 0});
  } else if (JumpPoint& point = points_[known.value]; cost < point.cost) {
    point = {cell, static_cast<std::uint32_t>(cost), parent, directions, 0};
  } else {
    // A way of the same length from another side may go on where the first one may not.
    const auto more = static_cast<std::uint8_t>(directions & ~(point.to_scan | point.scanned));
    if (cost > point.cost || more == 0) return;
    point.to_scan |= more;
  }
  open_.push_back({static_cast<std::uint32_t>(priority), known.value});
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

void JumpPointSearch::path(std::vector<GridCell>& path) const {
  path.assign(1, goal_);
  for (std::uint32_t point = (*cells_)[goal_].value; point != 0;) {
    point = points_[point].parent;
    GridCell at = path.back();
    const std::int32_t dx = points_[point].cell.x - at.x, dy = points_[point].cell.y - at.y;
    const std::int32_t diagonal = std::min(std::abs(dx), std::abs(dy));
    const std::int32_t straight = std::max(std::abs(dx), std::abs(dy)) - diagonal;
    const GridCell turn{dx > 0 ? 1 : -1, dy > 0 ? 1 : -1};
    const GridCell ahead{std::abs(dx) > std::abs(dy) ? turn.x : 0, std::abs(dx) > std::abs(dy) ? 0 : turn.y};
    // Backwards the straight part comes first.
    for (std::int32_t i = 0; i < straight; ++i) path.push_back(at = {at.x + ahead.x, at.y + ahead.y});
    for (std::int32_t i = 0; i < diagonal; ++i) path.push_back(at = {at.x + turn.x, at.y + turn.y});
  }
  std::reverse(path.begin(), path.end());
}

}  // namespace floornav
