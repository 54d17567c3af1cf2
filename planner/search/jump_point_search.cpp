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

}  // namespace

SearchOutcome JumpPointSearch::search(const BitGrid& grid, GridCell start, GridCell goal,
                                      const Interrupt& interrupt) {
  cells_->begin(grid.width(), grid.height(), start, goal);
  grid_ = &grid;
  goal_ = goal;
  expanded_ = 0;
  open_.clear();
  points_.clear();
  if (!grid.free(start) || !grid.free(goal)) return SearchOutcome::kNoPath;
  reach(start, 0xFF, 0, 0);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const std::uint32_t point = open_.back().point;
    open_.pop_back();
    if (points_[point].to_scan == 0) continue;
    if (points_[point].cell == goal) return SearchOutcome::kFound;
    if ((++expanded_ & (kPointsBetweenInterrupts - 1)) == 0 && interrupt && interrupt())
      return SearchOutcome::kInterrupted;
    expand(point);
  }
  return SearchOutcome::kNoPath;
}

void JumpPointSearch::expand(std::uint32_t point) {
  JumpPoint& p = points_[point];
  const GridCell cell = p.cell;
  const std::uint32_t cost = p.cost;
  unsigned directions = p.to_scan;
  p.scanned |= p.to_scan;
  p.to_scan = 0;
  for (; directions != 0; directions &= directions - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(directions));
    k % 2 == 0 ? scan_straight(cell, k, cost, point) : scan_diagonal(cell, k, cost, point);
  }
}

/// Goes on straight to the next jump point, or to the goal, if there is one before a blocked cell.
void JumpPointSearch::scan_straight(GridCell from, std::size_t k, std::uint64_t cost, std::uint32_t parent) {
  const bool along_rows = k == 0 || k == 4;
  const bool forward = k < 4;
  const BitGrid::Lines& lines = along_rows ? grid_->rows() : grid_->columns();
  const std::int32_t index = along_rows ? from.y : from.x, at = along_rows ? from.x : from.y;
  const std::uint64_t* const stops = lines.stops[forward ? 0 : 1].data() + lines.line(index);
  std::int32_t to = forward ? next_stop(stops, at) : previous_stop(stops, at);
  const std::int32_t goal =
      (along_rows ? goal_.y : goal_.x) == index ? (along_rows ? goal_.x : goal_.y) : kNone;
  const bool passed = goal != kNone && (forward ? goal > at && goal < to : goal < at && goal > to);
  if (passed)
    to = goal;
  else if (!lines.bit(index, to))
    return;
  const GridCell cell = along_rows ? GridCell{to, from.y} : GridCell{from.x, to};
  reach(cell, directions_after(cell, k),
        cost + std::uint64_t{kSteps.straight} * static_cast<std::uint32_t>(std::abs(to - at)), parent);
}

/// Goes on diagonally as far as the corner rule allows, and from each cell straight to both sides.
void JumpPointSearch::scan_diagonal(GridCell from, std::size_t k, std::uint64_t cost, std::uint32_t parent) {
  const std::size_t a = k - 1, b = (k + 1) % 8;
  const auto step = [](GridCell c, std::size_t d) { return GridCell{c.x + kStepX[d], c.y + kStepY[d]}; };
  while (grid_->free(step(from, a)) && grid_->free(step(from, b)) && grid_->free(step(from, k))) {
    from = step(from, k);
    cost += kSteps.diagonal;
    if (from == goal_) reach(from, 0xFF, cost, parent);
    scan_straight(from, a, cost, parent);
    scan_straight(from, b, cost, parent);
  }
}

/// Where a shortest way that comes straight to a cell may go on: straight, and around a corner that it has
/// just passed.
std::uint8_t JumpPointSearch::directions_after(GridCell cell, std::size_t k) const {
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
  std::uint32_t point = (*cells_)[goal_].value;
  while (point != 0) {
    point = points_[point].parent;
    const GridCell to = points_[point].cell;
    // Backwards the straight part comes first.
    for (GridCell c = path.back(); c != to; path.push_back(c)) {
      const std::int32_t dx = to.x - c.x, dy = to.y - c.y;
      if (std::abs(dx) >= std::abs(dy)) c.x += dx > 0 ? 1 : -1;
      if (std::abs(dy) >= std::abs(dx)) c.y += dy > 0 ? 1 : -1;
    }
  }
  std::reverse(path.begin(), path.end());
}

}  // namespace floornav
