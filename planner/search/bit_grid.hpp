#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/search/search_grid.hpp"

namespace floornav {

/// Free cells as bits, 64 a word, along the rows and again along the columns. One blocked cell lies around
/// the grid, so that a scan needs no bounds.
class BitGrid {
 public:
  /// All cells blocked.
  void reset(std::int32_t width, std::int32_t height);
  void set(GridCell cell, bool free);

  [[nodiscard]] std::int32_t width() const { return width_; }
  [[nodiscard]] std::int32_t height() const { return height_; }
  /// Also of the cells around the grid, which are blocked.
  [[nodiscard]] bool free(GridCell cell) const { return rows_.bit(cell.y, cell.x); }

  /// Lines of bits: bit `at + 1` of line `line + 1`, counted from the first word on, is the cell's.
  struct Lines {
    std::size_t words = 0;  ///< a line
    std::vector<std::uint64_t> bits;

    [[nodiscard]] const std::uint64_t* line(std::int32_t index) const {
      return bits.data() + static_cast<std::size_t>(index + 1) * words;
    }
    [[nodiscard]] bool bit(std::int32_t index, std::int32_t at) const {
      return (line(index)[static_cast<std::size_t>(at + 1) / 64] >> (static_cast<std::size_t>(at + 1) % 64) &
              1) != 0;
    }
  };
  [[nodiscard]] const Lines& rows() const { return rows_; }        ///< line y, at x
  [[nodiscard]] const Lines& columns() const { return columns_; }  ///< line x, at y

 private:
  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  Lines rows_;
  Lines columns_;
};

/// The cells of a search grid between which every step that the corner rule allows is open: those without any
/// open step are blocked, and so, to be on the safe side, is every cell that a closed edge parts from a
/// neighbour with open steps.
void project(const SearchGrid& grid, BitGrid& bits);

}  // namespace floornav
