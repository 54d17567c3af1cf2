#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "planner/search/large_pages.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

/// What searches remember of cells, eight bytes each. A cell holds what the running search wrote where it
/// bears that search's number, so that nothing is cleared between searches, and several kinds of search may
/// share one.
class SearchCells {
 public:
  static constexpr unsigned kFreeBits = 9;  ///< low bits of `tag`, for the search's own use
  struct Cell {
    std::uint32_t value = 0;
    std::uint32_t tag = 0;  ///< number of the search << kFreeBits, and its own bits
  };

  /// Begins a search on a grid; what the one before wrote is no longer valid. Throws std::invalid_argument
  /// for a grid too large or cells that are not on it.
  void begin(std::int32_t width, std::int32_t height, GridCell start, GridCell goal) {
    const auto on_grid = [&](GridCell c) { return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height; };
    if (width > SearchGrid::kMaxSide || height > SearchGrid::kMaxSide)
      throw std::invalid_argument("a search grid has at most 65535 cells along a side");
    if (!on_grid(start) || !on_grid(goal)) throw std::invalid_argument("start or goal off the search grid");
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (count > cells_.size() || number_ + 2 > kMaxNumber) {
      cells_.assign(std::max(count, cells_.size()), Cell{});
      number_ = 0;
    }
    number_ += 2;
    width_ = width;
  }

  [[nodiscard]] Cell* data() { return cells_.data(); }
  [[nodiscard]] const Cell& operator[](GridCell c) const { return cells_[index(c)]; }
  [[nodiscard]] std::size_t index(GridCell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(c.x);
  }
  /// The running search's number, as a tag bears it.
  [[nodiscard]] std::uint32_t tag() const { return number_ << kFreeBits; }
  /// A tag that is none of the running search's, nor of one before.
  [[nodiscard]] std::uint32_t mark() const { return (number_ - 1) << kFreeBits; }
  [[nodiscard]] bool current(const Cell& cell) const { return cell.tag >> kFreeBits == number_; }

 private:
  static constexpr std::uint32_t kMaxNumber = (1U << (32 - kFreeBits)) - 1;
  std::vector<Cell, LargePages<Cell>> cells_;
  std::uint32_t number_ = 0;
  std::int32_t width_ = 0;
};

}  // namespace floornav
