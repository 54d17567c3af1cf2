#include "planner/gap_field.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace floornav {
namespace {

/// Squared gap in half cells between a cell's centre and a cell `distance` columns or rows away.
constexpr std::int16_t squared_gap(std::int32_t distance) {
  return distance == 0 ? std::int16_t{0} : static_cast<std::int16_t>((2 * distance - 1) * (2 * distance - 1));
}

/// Counts the rows since the last obstacle, saturating at `most`.
void count_row(const std::uint8_t* kinds, std::uint8_t obstacle_from, std::uint8_t most, std::int32_t count,
               std::uint8_t* run) {
  for (std::int32_t i = 0; i < count; ++i) {
    const auto next = static_cast<std::uint8_t>(run[i] + 1);
    const std::uint8_t limited = next < most ? next : most;
    run[i] = kinds[i] >= obstacle_from ? std::uint8_t{0} : limited;
  }
}

}  // namespace

void GapField::reset(std::int32_t width, std::int32_t height, std::int32_t reach) {
  if (reach < 1 || reach > kMaxReach) throw std::invalid_argument("the reach of a gap field is 1..63 cells");
  width_ = width;
  height_ = height;
  reach_ = reach;
  gaps_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), cap());
  across_.clear();
  for (std::int32_t dx = 0; dx <= reach; ++dx) across_.push_back(squared_gap(dx));
}

void GapField::update(const std::vector<std::uint8_t>& kinds, std::uint8_t obstacle_from,
                      const CellRect& changed) {
  const CellRect grid{0, 0, width_, height_};
  const CellRect out = changed.grown(reach_).clipped(grid);
  if (out.empty()) return;
  const CellRect in = out.grown(reach_).clipped(grid);
  const auto columns = static_cast<std::size_t>(in.width());
  const auto most = static_cast<std::uint8_t>(reach_ + 1);
  const auto row = [&](std::int32_t y) {
    return kinds.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(in.x0);
  };

  run_.assign(columns, most);
  rows_up_.resize(columns * static_cast<std::size_t>(out.height()));
  for (std::int32_t y = in.y0; y < out.y1; ++y) {
    count_row(row(y), obstacle_from, most, in.width(), run_.data());
    if (y >= out.y0)
      std::copy(run_.begin(), run_.end(),
                rows_up_.begin() + static_cast<std::ptrdiff_t>(columns) * (y - out.y0));
  }

  // The row is padded so that a window of the reach around each cell of `out` stays within it.
  const auto pad = static_cast<std::size_t>(reach_);
  vertical_.assign(columns + 2 * pad, cap());
  std::array<std::int16_t, kMaxReach + 2> squares;
  for (std::int32_t n = 0; n <= reach_; ++n) squares[static_cast<std::size_t>(n)] = squared_gap(n);
  squares[static_cast<std::size_t>(most)] = cap();
  run_.assign(columns, most);
  for (std::int32_t y = in.y1 - 1; y >= out.y0; --y) {
    count_row(row(y), obstacle_from, most, in.width(), run_.data());
    if (y >= out.y1) continue;
    const std::uint8_t* up = rows_up_.data() + columns * static_cast<std::size_t>(y - out.y0);
    for (std::size_t i = 0; i < columns; ++i) vertical_[pad + i] = squares[std::min(run_[i], up[i])];
    const std::int16_t* from = vertical_.data() + pad + (out.x0 - in.x0);
    std::int16_t* const gaps = gaps_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(out.x0);
    least_in_row(from, gaps, out.width());
  }
}

/// The least, over all columns within reach, of the gap within the column and the gap across to it.
void GapField::least_in_row(const std::int16_t* vertical, std::int16_t* gaps, std::int32_t count) const {
  std::copy(vertical, vertical + count, gaps);
  for (std::int32_t dx = 1; dx <= reach_; ++dx) {
    const std::int16_t across = across_[static_cast<std::size_t>(dx)];
    for (std::int32_t i = 0; i < count; ++i) {
      const std::int16_t nearer = std::min(vertical[i - dx], vertical[i + dx]);
      gaps[i] = std::min(gaps[i], static_cast<std::int16_t>(nearer + across));
    }
  }
}

}  // namespace floornav
