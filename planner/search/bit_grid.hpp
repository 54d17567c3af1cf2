#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/search/search_grid.hpp"

namespace floornav {

/// Free cells as bits, 64 a word, along the rows and again along the columns; and for each direction along
/// them the places where a scan over free cells stops. One blocked cell lies around the grid, so that a scan
/// needs no bounds.
class BitGrid {
 public:
  /// All cells blocked.
  void reset(std::int32_t width, std::int32_t height);
  void set(GridCell cell, bool free);
  /// Calls free_at(cell) for every cell of a new grid: quicker than setting each.
  template <class FreeAt>
  void build(std::int32_t width, std::int32_t height, const FreeAt& free_at) {
    reset(width, height);
    for (std::int32_t y = 0; y < height; ++y)
      for (std::int32_t x = 0; x < width; ++x)
        if (free_at(GridCell{x, y})) rows_.put(y, x, true), columns_.put(x, y, true);
    count_all();
  }

  [[nodiscard]] std::int32_t width() const { return width_; }
  [[nodiscard]] std::int32_t height() const { return height_; }
  /// Also of the cells around the grid, which are blocked.
  [[nodiscard]] bool free(GridCell cell) const { return rows_.bit(cell.y, cell.x); }

  /// Lines of bits: bit `at + 1` of line `line + 1`, counted from the first word on, is the cell's.
  struct Lines {
    std::size_t words = 0;  ///< a line
    std::vector<std::uint64_t> bits;
    /// Scanning towards greater and towards smaller `at`: blocked, or a cell beside is free and the one
    /// before that is not, so that a way may have to turn.
    std::array<std::vector<std::uint64_t>, 2> stops;

    [[nodiscard]] std::size_t line(std::int32_t index) const {
      return static_cast<std::size_t>(index + 1) * words;
    }
    [[nodiscard]] bool bit(std::int32_t index, std::int32_t at) const {
      const auto place = static_cast<std::size_t>(at + 1);
      return (bits[line(index) + place / 64] >> (place % 64) & 1) != 0;
    }
    void reset(std::int32_t count, std::int32_t length);
    void put(std::int32_t index, std::int32_t at, bool value);
  };
  [[nodiscard]] const Lines& rows() const { return rows_; }        ///< line y, at x
  [[nodiscard]] const Lines& columns() const { return columns_; }  ///< line x, at y

  /// How many places there are for a way to turn, all four directions counted: a free cell, and a side of a
  /// free cell that a blocked one is beside. They decide how well jump points do.
  [[nodiscard]] double turns_per_cell() const;
  [[nodiscard]] double turns_per_border() const;

 private:
  void count_all();
  [[nodiscard]] double turns() const;
  void find_stops(Lines& lines, std::size_t line, std::size_t word);

  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  std::int64_t free_ = 0;
  std::int64_t stops_ = 0;    ///< bits set in all `stops`
  std::int64_t borders_ = 0;  ///< sides between a free cell and a blocked one
  Lines rows_;
  Lines columns_;
};

/// Whether every step from the cell that the corner rule allows is open: none of its edges is shut to a
/// neighbour that has open ones. Of cells like that the bits of a grid are made, on the safe side: those
/// without any open step are blocked, and so is every cell that a closed edge parts from a neighbour.
bool in_the_open(const SearchGrid& grid, GridCell cell);

/// The bits of a whole search grid.
void project(const SearchGrid& grid, BitGrid& bits);

}  // namespace floornav
