#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "planner/search/block_weights.hpp"
#include "planner/search/bucket_queue.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

/// Lower bounds of what the way from a cell to a goal costs, from the least weights of a grid's blocks.
///
/// A function over the plane bounds the cost of every way from below where it is 0 at the goal and nowhere
/// steeper than a step is dear. This one is linear on the two triangles of every block, cut along the
/// diagonal through its lowest corner. It is steep enough nowhere if of every block, with `straight` and
/// `diagonal` the least costs along its side and its diagonal, two corners on a side differ by at most
/// `straight`, two on a diagonal by at most `diagonal`, and each corner p between two opposite ones m and o
/// has 2 p <= m + o + diagonal. The largest such values come out of Dijkstra's search over the corners: the
/// third rule too raises a value beyond those that it comes from. The bounds are consistent along every step.
class GoalBounds {
 public:
  /// From now on for this goal. `blocks` must stay as they are until the next begin().
  void begin(const BlockWeights& blocks, StepCosts steps, GridCell goal);

  /// Works out what the bound of the cell needs. False: `interrupt`, which may be empty, told to give up.
  bool reach(GridCell cell, const std::function<bool()>& interrupt);
  /// No way leads from the cell to the goal, or only one whose cost overflows.
  [[nodiscard]] bool shut_off(GridCell cell);
  /// 0 of a cell that is shut off. Works out more where it must.
  [[nodiscard]] std::uint32_t operator()(GridCell cell);

  /// Corners of blocks looked at since begin().
  [[nodiscard]] std::int64_t expanded() const { return expanded_; }

 private:
  static constexpr std::uint32_t kUnreached = 0xFFFFFFFF;
  static constexpr std::uint32_t kFarthest = 0xF0000000;  ///< sums stay within 32 bits up to here
  /// Least costs of crossing a block; kUnreached: it is shut.
  struct Crossing {
    std::uint32_t straight = kUnreached;
    std::uint32_t diagonal = kUnreached;
  };
  struct Corners {
    std::uint32_t low_left, low_right, high_left, high_right;
    [[nodiscard]] std::uint32_t highest() const;
  };

  void find_crossings(StepCosts steps);
  [[nodiscard]] Corners corners_of(GridCell cell) const;
  bool expand_next();
  void expand(std::size_t corner, std::uint32_t value);
  void lower(std::size_t corner, std::uint32_t value);

  const BlockWeights* blocks_ = nullptr;
  StepCosts steps_;
  std::array<Crossing, 256> crossings_;  ///< by a block's weight
  std::size_t stride_ = 0;               ///< corners of a row
  std::vector<std::uint32_t> values_;    ///< of the corners
  BucketQueue queue_;                    ///< of values >> bucket_bits_
  unsigned bucket_bits_ = 0;
  std::uint32_t final_below_ = 0;  ///< smaller values will not change
  std::int64_t expanded_ = 0;
};

}  // namespace floornav
