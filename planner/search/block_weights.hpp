#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/cell_rect.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

/// The least weight in each block of cells of a grid, kept up to date with it: a coarse view from which a
/// search may tell at once what a way costs at least (GoalBounds).
class BlockWeights {
 public:
  static constexpr std::int32_t kSide = 5;        ///< cells; finer bounds are closer, but take longer
  static constexpr std::uint8_t kShut = 255;      ///< of a block without any open step
  static constexpr std::uint8_t kHeaviest = 254;  ///< stands for 255 too

  /// All blocks shut, on a grid of width x height cells.
  void reset(std::int32_t width, std::int32_t height);
  /// Looks again at the blocks that hold cells of `changed`, which lies on the grid.
  void update(const SearchGrid& grid, const CellRect& changed);

  [[nodiscard]] std::int32_t columns() const { return columns_; }
  [[nodiscard]] std::int32_t rows() const { return rows_; }
  /// Of the block in a column and a row; those around the grid, from -1 on, are shut.
  [[nodiscard]] const std::uint8_t* at(std::int32_t column, std::int32_t row) const {
    return least_.data() + index(column, row);
  }
  friend bool operator==(const BlockWeights&, const BlockWeights&) = default;
  /// From a block to the one of the next row.
  [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(columns_) + 2; }

 private:
  [[nodiscard]] std::size_t index(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row + 1) * stride() + static_cast<std::size_t>(column + 1);
  }

  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::vector<std::uint8_t> least_;
};

/// The blocks of a whole grid.
BlockWeights block_weights(const SearchGrid& grid);

}  // namespace floornav
