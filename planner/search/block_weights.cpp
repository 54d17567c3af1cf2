#include "planner/search/block_weights.hpp"

#include <algorithm>

namespace floornav {
namespace {

std::uint8_t least_weight(const SearchGrid& grid, const CellRect& block) {
  std::uint8_t least = BlockWeights::kShut;
  for (std::int32_t y = block.y0; y < block.y1; ++y) {
    for (std::int32_t x = block.x0; x < block.x1; ++x) {
      const std::size_t i = grid.index({x, y});
      if (grid.edges[i] == 0) continue;
      const std::uint8_t weight = grid.weights.empty() ? std::uint8_t{0} : grid.weights[i];
      least = std::min({least, weight, BlockWeights::kHeaviest});
    }
  }
  return least;
}

}  // namespace

void BlockWeights::reset(std::int32_t width, std::int32_t height) {
  columns_ = (width + kSide - 1) / kSide;
  rows_ = (height + kSide - 1) / kSide;
  least_.assign(stride() * (static_cast<std::size_t>(rows_) + 2), kShut);
}

void BlockWeights::update(const SearchGrid& grid, const CellRect& changed) {
  const CellRect cells{0, 0, grid.width, grid.height};
  for (std::int32_t row = changed.y0 / kSide; row * kSide < changed.y1; ++row) {
    for (std::int32_t column = changed.x0 / kSide; column * kSide < changed.x1; ++column) {
      const CellRect block{column * kSide, row * kSide, (column + 1) * kSide, (row + 1) * kSide};
      least_[index(column, row)] = least_weight(grid, block.clipped(cells));
    }
  }
}

BlockWeights block_weights(const SearchGrid& grid) {
  BlockWeights blocks;
  blocks.reset(grid.width, grid.height);
  blocks.update(grid, {0, 0, grid.width, grid.height});
  return blocks;
}

}  // namespace floornav
