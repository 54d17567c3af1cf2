#pragma once

#include "planner/search/bit_grid.hpp"
#include "planner/search/block_weights.hpp"

namespace floornav {

/// What is kept beside a search grid to make searches quick; each may be missing.
struct GridAids {
  const BitGrid* whole_projection = nullptr;  ///< where it leaves out none of the grid's cells
  const BlockWeights* blocks = nullptr;       ///< of a weighted grid
};

}  // namespace floornav
