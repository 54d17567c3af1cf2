#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/cell_rect.hpp"

namespace floornav {

/// The clearance of cells: for the centre of each one the exact distance to the square of the nearest
/// obstacle cell, up to a reach, squared, in half cells. Only what lies around a change is worked out again.
class GapField {
 public:
  static constexpr std::int32_t kMaxReach = 63;  ///< cells; keeps sums of squares within 16 bits

  /// Forgets everything: no obstacle on a grid of width x height cells. Throws std::invalid_argument for a
  /// reach over kMaxReach or under 1.
  void reset(std::int32_t width, std::int32_t height, std::int32_t reach);

  /// Works out again all gaps that a change of cells within `changed` can alter. `kinds` holds width * height
  /// cells; those of a kind >= obstacle_from are obstacles. Beyond the grid there are none.
  void update(const std::vector<std::uint8_t>& kinds, std::uint8_t obstacle_from, const CellRect& changed);

  /// Squared gap in half cells; 0 of an obstacle, cap() where there is none within reach.
  [[nodiscard]] std::int16_t operator[](std::size_t index) const { return gaps_[index]; }
  [[nodiscard]] std::int32_t reach() const { return reach_; }
  [[nodiscard]] std::int16_t cap() const {
    return static_cast<std::int16_t>((2 * reach_ + 1) * (2 * reach_ + 1));
  }

 private:
  void least_in_row(const std::int16_t* vertical, std::int16_t* gaps, std::int32_t count) const;

  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  std::int32_t reach_ = 1;
  std::vector<std::int16_t> gaps_;
  std::vector<std::int16_t> across_;    ///< squared gap of a column `dx` away
  std::vector<std::uint8_t> run_;       ///< rows since the last obstacle, a column
  std::vector<std::uint8_t> rows_up_;   ///< rows to the nearest obstacle of smaller y, each cell of the area
  std::vector<std::int16_t> vertical_;  ///< squared gap within the column, one row, padded by the reach
};

}  // namespace floornav
