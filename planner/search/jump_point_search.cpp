#include "planner/search/jump_point_search.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <functional>
#include <limits>
#include <stdexcept>

#include "planner/search/octile.hpp"

namespace floornav {
namespace {

constexpr std::int64_t kPointsBetweenInterrupts = 128;
constexpr StepCosts kSteps = kExactSteps;

constexpr std::int32_t kNone = -1;

/// A line of cells and the two beside it.
struct Beside {
  const std::uint64_t* line;
  const std::uint64_t* a;
  const std::uint64_t* b;
  std::size_t words;
};

/// What ends a straight scan at bit `bit` of word `w`: the goal, where it was passed; a blocked cell, and
/// there is nothing to go to; or a cell where a way may have to turn.
std::int32_t end_of_scan(const Beside& lines, std::size_t w, int bit, std::int32_t from, std::int32_t goal) {
  const std::int32_t at = static_cast<std::int32_t>(w * 64) + bit - 1;
  const bool blocked = (lines.line[w] >> bit & 1) == 0;
  const bool passed = from < at ? goal > from && goal < at : goal != kNone && goal < from && goal > at;
  if (passed) return goal;
  return blocked ? kNone : at;
}

/// The first cell after `from` where a way may have to turn, since a cell beside is free and the one before
/// that is not; kNone where a blocked cell comes first. A bit ahead of a cell's own stands for the blocked
/// cell around the grid.
std::int32_t scan_forward(const Beside& lines, std::int32_t from, std::int32_t goal) {
  const auto first = static_cast<std::size_t>(from + 1) + 1;
  std::uint64_t ahead = ~0ULL << (first % 64);
  for (std::size_t w = first / 64;; ++w, ahead = ~0ULL) {
    const std::uint64_t a_before = lines.a[w] << 1 | (w > 0 ? lines.a[w - 1] >> 63 : 0);
    const std::uint64_t b_before = lines.b[w] << 1 | (w > 0 ? lines.b[w - 1] >> 63 : 0);
    const std::uint64_t stops =
        (~lines.line[w] | (lines.a[w] & ~a_before) | (lines.b[w] & ~b_before)) & ahead;
    if (stops != 0) return end_of_scan(lines, w, std::countr_zero(stops), from, goal);
  }
}

/// As scan_forward, towards smaller coordinates.
std::int32_t scan_backward(const Beside& lines, std::int32_t from, std::int32_t goal) {
  const auto last = static_cast<std::size_t>(from + 1) - 1;
  std::uint64_t ahead = ~0ULL >> (63 - last % 64);
  for (std::size_t w = last / 64;; --w, ahead = ~0ULL) {
    const bool more = w + 1 < lines.words;
    const std::uint64_t a_before = lines.a[w] >> 1 | (more ? lines.a[w + 1] << 63 : 0);
    const std::uint64_t b_before = lines.b[w] >> 1 | (more ? lines.b[w + 1] << 63 : 0);
    const std::uint64_t stops =
        (~lines.line[w] | (lines.a[w] & ~a_before) | (lines.b[w] & ~b_before)) & ahead;
    if (stops != 0) return end_of_scan(lines, w, 63 - std::countl_zero(stops), from, goal);
  }
}

}  // namespace

void JumpPointSearch::prepare(const BitGrid& grid, GridCell start, GridCell goal) {
  const auto on_grid = [&](GridCell c) {
    return c.x >= 0 && c.y >= 0 && c.x < grid.width() && c.y < grid.height();
  };
  if (!on_grid(start) || !on_grid(goal)) throw std::invalid_argument("start or goal off the grid");
  if (grid.width() > SearchGrid::kMaxSide || grid.height() > SearchGrid::kMaxSide)
    throw std::invalid_argument("a search grid has at most 65535 cells along a side");
  const std::size_t cells = static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(grid.height());
  if (cells > nodes_.size() || number_ == std::numeric_limits<std::uint32_t>::max()) {
    nodes_.assign(std::max(cells, nodes_.size()), Node{});
    number_ = 0;
  }
  ++number_;
  grid_ = &grid;
  width_ = grid.width();
  start_ = start;
  goal_ = goal;
  expanded_ = 0;
  open_.clear();
}

SearchOutcome JumpPointSearch::search(const BitGrid& grid, GridCell start, GridCell goal,
                                      const Interrupt& interrupt) {
  prepare(grid, start, goal);
  if (!grid.free(start) || !grid.free(goal)) return SearchOutcome::kNoPath;
  reach(start, 0xFF, 0, index(start));
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const GridCell cell = unpack(open_.back().item);
    open_.pop_back();
    Node& node = nodes_[index(cell)];
    if (node.to_scan == 0) continue;
    if (cell == goal) return SearchOutcome::kFound;
    if ((++expanded_ & (kPointsBetweenInterrupts - 1)) == 0 && interrupt && interrupt())
      return SearchOutcome::kInterrupted;
    const unsigned directions = node.to_scan;
    node.scanned |= node.to_scan;
    node.to_scan = 0;
    for (unsigned left = directions; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      k % 2 == 0 ? scan_straight(cell, k, node.cost, index(cell))
                 : scan_diagonal(cell, k, node.cost, index(cell));
    }
  }
  return SearchOutcome::kNoPath;
}

/// Goes on straight to the next jump point, if there is one.
void JumpPointSearch::scan_straight(GridCell from, std::size_t k, std::uint64_t cost, std::uint32_t parent) {
  const bool along_rows = k == 0 || k == 4;
  const BitGrid::Lines& lines = along_rows ? grid_->rows() : grid_->columns();
  const std::int32_t index = along_rows ? from.y : from.x, at = along_rows ? from.x : from.y;
  const bool goal_on_line = (along_rows ? goal_.y : goal_.x) == index;
  const std::int32_t goal = goal_on_line ? (along_rows ? goal_.x : goal_.y) : kNone;
  const Beside beside{lines.line(index), lines.line(index - 1), lines.line(index + 1), lines.words};
  const std::int32_t to = k < 4 ? scan_forward(beside, at, goal) : scan_backward(beside, at, goal);
  if (to == kNone) return;
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
  Node& node = nodes_[index(cell)];
  if (node.search != number_ || cost < node.cost) {
    node = {static_cast<std::uint32_t>(cost), number_, parent, directions, 0};
  } else {
    // A way of the same length from another side may go on where the first one may not.
    const auto more = static_cast<std::uint8_t>(directions & ~(node.to_scan | node.scanned));
    if (cost > node.cost || more == 0) return;
    node.to_scan |= more;
  }
  open_.push_back({static_cast<std::uint32_t>(priority), pack(cell)});
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

void JumpPointSearch::path(std::vector<GridCell>& path) const {
  path.assign(1, goal_);
  const auto width = static_cast<std::uint32_t>(width_);
  const auto index = [&](GridCell c) {
    return static_cast<std::uint32_t>(c.y) * width + static_cast<std::uint32_t>(c.x);
  };
  while (path.back() != start_) {
    const std::uint32_t parent = nodes_[index(path.back())].parent;
    const GridCell to{static_cast<std::int32_t>(parent % width), static_cast<std::int32_t>(parent / width)};
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
