#include "planner/search/bit_grid.hpp"

namespace floornav {
namespace {

void reset_lines(BitGrid::Lines& lines, std::int32_t count, std::int32_t length) {
  lines.words = (static_cast<std::size_t>(length) + 2 + 63) / 64;
  lines.bits.assign((static_cast<std::size_t>(count) + 2) * lines.words, 0);
}

void set_bit(BitGrid::Lines& lines, std::int32_t line, std::int32_t at, bool value) {
  const auto bit = static_cast<std::size_t>(at + 1);
  std::uint64_t& word = lines.bits[static_cast<std::size_t>(line + 1) * lines.words + bit / 64];
  const std::uint64_t mask = 1ULL << (bit % 64);
  word = value ? word | mask : word & ~mask;
}

/// No edge parts the cell from a neighbour that can be moved on; a diagonal one counts where the corner rule
/// would let it be open.
bool parted_from_none(const SearchGrid& grid, GridCell cell) {
  const unsigned open = grid.edges[grid.index(cell)];
  const auto has_steps = [&](std::size_t k) {
    const GridCell to{cell.x + kStepX[k], cell.y + kStepY[k]};
    return grid.contains(to) && grid.edges[grid.index(to)] != 0;
  };
  for (std::size_t k = 0; k < 8; ++k) {
    if ((open >> k & 1) != 0 || !has_steps(k)) continue;
    if (k % 2 == 0 || (has_steps(k - 1) && has_steps((k + 1) % 8))) return false;
  }
  return true;
}

}  // namespace

void BitGrid::reset(std::int32_t width, std::int32_t height) {
  width_ = width;
  height_ = height;
  reset_lines(rows_, height, width);
  reset_lines(columns_, width, height);
}

void BitGrid::set(GridCell cell, bool free) {
  set_bit(rows_, cell.y, cell.x, free);
  set_bit(columns_, cell.x, cell.y, free);
}

void project(const SearchGrid& grid, BitGrid& bits) {
  bits.reset(grid.width, grid.height);
  for (std::int32_t y = 0; y < grid.height; ++y)
    for (std::int32_t x = 0; x < grid.width; ++x)
      if (grid.edges[grid.index({x, y})] != 0 && parted_from_none(grid, {x, y})) bits.set({x, y}, true);
}

}  // namespace floornav
