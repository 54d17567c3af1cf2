#include "planner/search/goal_bounds.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace floornav {
namespace {

constexpr std::uint32_t kSide = BlockWeights::kSide;
constexpr std::int64_t kCornersBetweenInterrupts = 1024;

}  // namespace

void GoalBounds::begin(const BlockWeights& blocks, StepCosts steps, GridCell goal) {
  find_crossings(steps);
  blocks_ = &blocks;
  stride_ = static_cast<std::size_t>(blocks.columns()) + 1;
  values_.assign(stride_ * (static_cast<std::size_t>(blocks.rows()) + 1), kUnreached);
  // A value is final once its bucket is reached if none is raised by less than a bucket's width: a side costs
  // more than that, and so does what the third rule adds where it tells more than the first.
  const Crossing& lightest = crossings_[0];
  bucket_bits_ = static_cast<unsigned>(std::bit_width(lightest.diagonal - lightest.straight)) - 1;
  queue_.reset((crossings_[BlockWeights::kHeaviest].diagonal >> bucket_bits_) + 2);
  final_below_ = 0;
  expanded_ = 0;
  const auto column = static_cast<std::size_t>(goal.x) / kSide,
             row = static_cast<std::size_t>(goal.y) / kSide;
  for (const std::size_t corner : {row * stride_ + column, (row + 1) * stride_ + column})
    for (const std::size_t next : {std::size_t{0}, std::size_t{1}}) lower(corner + next, 0);
}

/// Costs of steps are rounded down, where they have a fraction: half a step on either side of a border loses
/// one unit at the most if that with a weight is taken for two units less.
void GoalBounds::find_crossings(StepCosts steps) {
  if (steps_.straight == steps.straight && steps_.diagonal == steps.diagonal) return;
  steps_ = steps;
  for (std::uint32_t weight = 0; weight <= BlockWeights::kHeaviest; ++weight) {
    const auto crossing = [&](std::uint32_t base) {
      const std::uint32_t steps_of_block = kSide * base * (SearchGrid::kWeightUnit + weight);
      return steps_of_block / SearchGrid::kWeightUnit - (weight > 0 ? 2 * kSide : 0);
    };
    crossings_[weight] = {crossing(steps.straight), crossing(steps.diagonal)};
  }
  crossings_[BlockWeights::kShut] = {};
}

bool GoalBounds::reach(GridCell cell, const std::function<bool()>& interrupt) {
  while (corners_of(cell).highest() >= final_below_ && expand_next())
    if (expanded_ % kCornersBetweenInterrupts == 0 && interrupt && interrupt()) return false;
  return true;
}

bool GoalBounds::shut_off(GridCell cell) {
  reach(cell, {});
  return corners_of(cell).highest() == kUnreached;
}

std::uint32_t GoalBounds::operator()(GridCell cell) {
  Corners c = corners_of(cell);
  while (c.highest() >= final_below_ && expand_next()) c = corners_of(cell);
  if (c.highest() == kUnreached) return 0;
  // Mirrored so that the lowest corner is the low left one; the cell's centre in halves of a cell from there.
  std::uint32_t x = 2 * (static_cast<std::uint32_t>(cell.x) % kSide) + 1;
  std::uint32_t y = 2 * (static_cast<std::uint32_t>(cell.y) % kSide) + 1;
  if (std::min(c.low_right, c.high_right) < std::min(c.low_left, c.high_left)) {
    std::swap(c.low_left, c.low_right);
    std::swap(c.high_left, c.high_right);
    x = 2 * kSide - x;
  }
  if (c.high_left < c.low_left) {
    std::swap(c.low_left, c.high_left);
    std::swap(c.low_right, c.high_right);
    y = 2 * kSide - y;
  }
  const std::uint32_t side = x >= y ? c.low_right : c.high_left;
  // First along the side, then beside it to the diagonal: the last term may be negative, their sum is not.
  const std::uint32_t rise = std::max(x, y) * (side - c.low_left) + std::min(x, y) * (c.high_right - side);
  return c.low_left + rise / (2 * kSide);
}

std::uint32_t GoalBounds::Corners::highest() const {
  return std::max(std::max(low_left, low_right), std::max(high_left, high_right));
}

GoalBounds::Corners GoalBounds::corners_of(GridCell cell) const {
  const std::uint32_t* const low = values_.data() + static_cast<std::uint32_t>(cell.y) / kSide * stride_ +
                                   static_cast<std::uint32_t>(cell.x) / kSide;
  return {low[0], low[1], low[stride_], low[stride_ + 1]};
}

void GoalBounds::lower(std::size_t corner, std::uint32_t value) {
  if (values_[corner] <= value) return;
  values_[corner] = value;
  queue_.push(value >> bucket_bits_, static_cast<std::uint32_t>(corner));
}

/// False: there are no more.
bool GoalBounds::expand_next() {
  std::uint32_t corner = 0;
  if (!queue_.pop(corner)) {
    final_below_ = kUnreached;
    return false;
  }
  const std::uint32_t value = values_[corner], bucket_begin = value >> bucket_bits_ << bucket_bits_;
  if (bucket_begin < final_below_) return true;  // expanded at a lower value
  final_below_ = bucket_begin;
  ++expanded_;
  if (value <= kFarthest) expand(corner, value);
  return true;
}

void GoalBounds::expand(std::size_t corner, std::uint32_t value) {
  const std::size_t left = corner - 1, right = corner + 1, below = corner - stride_, above = corner + stride_;
  const std::uint8_t* const low = blocks_->at(static_cast<std::int32_t>(corner % stride_) - 1,
                                              static_cast<std::int32_t>(corner / stride_) - 1);
  const std::uint8_t* const high = low + blocks_->stride();
  const Crossing low_left = crossings_[low[0]], low_right = crossings_[low[1]];
  const Crossing high_left = crossings_[high[0]], high_right = crossings_[high[1]];
  const auto straight = [&](std::size_t to, const Crossing& a, const Crossing& b) {
    const std::uint32_t cost = std::min(a.straight, b.straight);
    if (cost != kUnreached) lower(to, value + cost);
  };
  straight(left, low_left, high_left);
  straight(right, low_right, high_right);
  straight(below, low_left, low_right);
  straight(above, high_left, high_right);
  const auto diagonal = [&](std::size_t to, std::size_t beside, std::size_t other, const Crossing& block) {
    if (block.diagonal == kUnreached) return;
    lower(to, value + block.diagonal);
    if (values_[to] > value) return;  // the third rule takes the higher of the two
    const std::uint64_t sum = std::uint64_t{value} + values_[to] + block.diagonal;
    lower(beside, static_cast<std::uint32_t>(sum / 2));
    lower(other, static_cast<std::uint32_t>(sum / 2));
  };
  diagonal(below - 1, left, below, low_left);
  diagonal(below + 1, right, below, low_right);
  diagonal(above - 1, left, above, high_left);
  diagonal(above + 1, right, above, high_right);
}

}  // namespace floornav
