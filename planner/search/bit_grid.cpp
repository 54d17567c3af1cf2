#include "planner/search/bit_grid.hpp"

#include <algorithm>
#include <bit>

namespace floornav {

void BitGrid::Lines::reset(std::int32_t count, std::int32_t length) {
  words = (static_cast<std::size_t>(length) + 2 + 63) / 64;
  bits.assign((static_cast<std::size_t>(count) + 2) * words, 0);
  for (auto& s : stops) s.assign(bits.size(), ~0ULL);
}

void BitGrid::Lines::put(std::int32_t index, std::int32_t at, bool value) {
  const auto place = static_cast<std::size_t>(at + 1);
  std::uint64_t& word = bits[line(index) + place / 64];
  const std::uint64_t mask = 1ULL << (place % 64);
  word = value ? word | mask : word & ~mask;
}

void BitGrid::reset(std::int32_t width, std::int32_t height) {
  width_ = width;
  height_ = height;
  free_ = borders_ = 0;
  rows_.reset(height, width);
  columns_.reset(width, height);
  stops_ = static_cast<std::int64_t>(2 * 64 * (rows_.bits.size() + columns_.bits.size()));
}

void BitGrid::set(GridCell cell, bool free) {
  if (this->free(cell) == free) return;
  free_ += free ? 1 : -1;
  for (std::size_t k = 0; k < 8; k += 2)
    borders_ += this->free({cell.x + kStepX[k], cell.y + kStepY[k]}) == free ? -1 : 1;
  rows_.put(cell.y, cell.x, free);
  columns_.put(cell.x, cell.y, free);
  const auto find_around = [&](Lines& lines, std::int32_t index, std::int32_t at, std::int32_t count) {
    for (std::int32_t i = std::max(index - 1, 0); i <= std::min(index + 1, count - 1); ++i) {
      const std::size_t first = static_cast<std::size_t>(at) / 64,
                        last = static_cast<std::size_t>(at + 2) / 64;
      for (std::size_t word = first; word <= last && word < lines.words; ++word)
        find_stops(lines, static_cast<std::size_t>(i) + 1, word);
    }
  };
  find_around(rows_, cell.y, cell.x, height_);
  find_around(columns_, cell.x, cell.y, width_);
}

void BitGrid::count_all() {
  free_ = borders_ = 0;
  for (const std::uint64_t word : rows_.bits) free_ += std::popcount(word);
  for (Lines* const lines : {&rows_, &columns_}) {
    for (std::size_t line = 1; (line + 1) * lines->words < lines->bits.size(); ++line) {
      std::uint64_t before = 0;
      for (std::size_t word = 0; word < lines->words; ++word) {
        find_stops(*lines, line, word);
        const std::uint64_t cells = lines->bits[line * lines->words + word];
        borders_ += std::popcount(cells ^ (cells << 1 | before));
        before = cells >> 63;
      }
    }
  }
}

/// `line` counts the one around the grid.
void BitGrid::find_stops(Lines& lines, std::size_t line, std::size_t word) {
  const std::size_t here = line * lines.words + word;
  const std::uint64_t free = lines.bits[here];
  std::uint64_t up = ~free, down = ~free;
  for (const std::size_t beside : {here - lines.words, here + lines.words}) {
    const std::uint64_t cells = lines.bits[beside];
    const std::uint64_t lower = word > 0 ? lines.bits[beside - 1] >> 63 : 0;
    const std::uint64_t higher = word + 1 < lines.words ? lines.bits[beside + 1] << 63 : 0;
    up |= cells & ~(cells << 1 | lower);
    down |= cells & ~(cells >> 1 | higher);
  }
  stops_ += std::popcount(up) + std::popcount(down);
  stops_ -= std::popcount(lines.stops[0][here]) + std::popcount(lines.stops[1][here]);
  lines.stops[0][here] = up;
  lines.stops[1][here] = down;
}

double BitGrid::turns() const {
  const auto cells = static_cast<std::int64_t>(64 * (rows_.bits.size() + columns_.bits.size()));
  const std::int64_t stops_of_blocked = 2 * (cells - 2 * free_);
  return static_cast<double>(stops_ - stops_of_blocked);
}

double BitGrid::turns_per_cell() const {
  return free_ > 0 ? turns() / static_cast<double>(free_) : 0.0;
}

double BitGrid::turns_per_border() const {
  return borders_ > 0 ? turns() / static_cast<double>(borders_) : 0.0;
}

bool in_the_open(const SearchGrid& grid, GridCell cell) {
  const unsigned open = grid.edges[grid.index(cell)];
  if (open == 0xFF) return true;
  if (open == 0) return false;
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

void project(const SearchGrid& grid, BitGrid& bits) {
  bits.build(grid.width, grid.height, [&](GridCell cell) { return in_the_open(grid, cell); });
}

}  // namespace floornav
