#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/cell_rect.hpp"

namespace floornav {

/// Cells of a grid, a byte each; those that share a bit with `obstacles` are obstacles.
struct ObstacleCells {
  const std::uint8_t* kinds = nullptr;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::uint8_t obstacles = 0;
};

/// Works out clearances: for the centre of each cell the exact distance to the square of the nearest obstacle
/// cell, up to a reach, squared, in half cells. Beyond the grid there are no obstacles.
class GapScan {
 public:
  static constexpr std::int32_t kMaxReach = 63;  ///< cells; keeps sums of squares within 16 bits

  /// Throws std::invalid_argument for a reach over kMaxReach or under 1.
  explicit GapScan(std::int32_t reach = 1);

  /// Calls row(y, gaps) for every row of `out`, which lies on the grid, from the highest y down; gaps[i] is
  /// that of cell (out.x0 + i, y): 0 of an obstacle, cap() where there is none within reach.
  template <class Row>
  void scan(const ObstacleCells& cells, const CellRect& out, const Row& row) {
    begin(cells, out);
    for (std::int32_t y = in_.y1 - 1; y >= out.y0; --y)
      if (next_row(cells, out, y)) row(y, gaps_.data());
  }

  [[nodiscard]] std::int32_t reach() const { return reach_; }
  [[nodiscard]] std::int16_t cap() const {
    return static_cast<std::int16_t>((2 * reach_ + 1) * (2 * reach_ + 1));
  }

 private:
  void begin(const ObstacleCells& cells, const CellRect& out);
  bool next_row(const ObstacleCells& cells, const CellRect& out, std::int32_t y);

  std::int32_t reach_;
  CellRect in_;                         ///< `out` and what lies within reach of it
  std::vector<std::int16_t> across_;    ///< squared gap of a column `dx` away
  std::vector<std::uint8_t> run_;       ///< rows since the last obstacle, a column
  std::vector<std::uint8_t> rows_up_;   ///< rows to the nearest obstacle of smaller y, each cell of the area
  std::vector<std::int16_t> vertical_;  ///< squared gap within the column, one row, padded by the reach
  std::vector<std::int16_t> gaps_;      ///< of one row of `out`
};

/// The clearances of a whole grid, of which only what lies around a change is worked out again.
class GapField {
 public:
  /// Forgets everything: no obstacle on a grid of width x height cells. Throws as GapScan.
  void reset(std::int32_t width, std::int32_t height, std::int32_t reach);

  /// Works out again all gaps that a change of cells within `changed` can alter; `cells` are of the size that
  /// reset() was told.
  void update(const ObstacleCells& cells, const CellRect& changed);

  /// As GapScan has it.
  [[nodiscard]] std::int16_t operator[](std::size_t index) const { return gaps_[index]; }
  [[nodiscard]] std::int32_t reach() const { return scan_.reach(); }
  [[nodiscard]] std::int16_t cap() const { return scan_.cap(); }

 private:
  GapScan scan_;
  std::vector<std::int16_t> gaps_;
};

}  // namespace floornav
