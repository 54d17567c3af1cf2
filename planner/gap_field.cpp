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

/// One row of a scan: `columns` cells of which every one has its run of rows down and up to an obstacle; of
/// them `count`, from `skip` on, get their gaps.
struct GapRow {
  const std::uint8_t* down;
  const std::uint8_t* up;
  std::size_t columns;
  std::int16_t* vertical;  ///< squared gap within the column; padded by the reach on both sides
  std::size_t skip;
  std::size_t count;
  const std::int16_t* across;  ///< squared gap of a column `dx` away
  std::size_t reaches;
  std::int16_t* gaps;
};

/// Counts the rows since the last obstacle, saturating at `most`.
void count_row(const std::uint8_t* kinds, std::uint8_t obstacles, std::uint8_t most, std::size_t count,
               std::uint8_t* run) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto next = static_cast<std::uint8_t>(run[i] + 1);
    const std::uint8_t limited = next < most ? next : most;
    run[i] = (kinds[i] & obstacles) != 0 ? std::uint8_t{0} : limited;
  }
}

constexpr std::size_t kBlock = 32;  ///< cells whose least gaps stay in registers

/// What the rows of a scan are made of; inlined into a function a kind of processor.
[[gnu::always_inline]] inline void row_of_gaps(const GapRow& r) {
  // A cell of run 0 is an obstacle; one of the longest run has none within reach, and its square is the cap.
  for (std::size_t i = 0; i < r.columns; ++i) {
    const std::int16_t odd = static_cast<std::int16_t>(2 * std::min(r.down[i], r.up[i]) - 1);
    const std::int16_t half_cells = std::max<std::int16_t>(odd, 0);
    r.vertical[i] = static_cast<std::int16_t>(half_cells * half_cells);
  }
  for (std::size_t first = 0; first < r.count; first += kBlock) {
    std::array<std::int16_t, kBlock> least;
    const std::int16_t* const here = r.vertical + r.skip + first;
    for (std::size_t i = 0; i < kBlock; ++i) least[i] = here[i];
    for (std::size_t dx = 1; dx < r.reaches; ++dx) {
      const std::int16_t squared = r.across[dx];
      for (std::size_t i = 0; i < kBlock; ++i) {
        const std::int16_t nearer = std::min((here - dx)[i], (here + dx)[i]);
        least[i] = std::min(least[i], static_cast<std::int16_t>(nearer + squared));
      }
    }
    for (std::size_t i = 0; i < kBlock; ++i) r.gaps[first + i] = least[i];
  }
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void row_with_avx2(const GapRow& r) {
  row_of_gaps(r);
}
const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
#endif

void fill_row(const GapRow& r) {
#ifdef __x86_64__
  if (kHasAvx2) return row_with_avx2(r);
#endif
  row_of_gaps(r);
}

}  // namespace

GapScan::GapScan(std::int32_t reach) : reach_(reach) {
  if (reach < 1 || reach > kMaxReach) throw std::invalid_argument("the reach of a gap field is 1..63 cells");
  for (std::int32_t dx = 0; dx <= reach; ++dx) across_.push_back(squared_gap(dx));
}

void GapScan::begin(const ObstacleCells& cells, const CellRect& out) {
  in_ = out.grown(reach_).clipped({0, 0, cells.width, cells.height});
  const auto columns = static_cast<std::size_t>(in_.width());
  const auto most = static_cast<std::uint8_t>(reach_ + 1);
  run_.assign(columns, most);
  rows_up_.resize(columns * static_cast<std::size_t>(out.height()));
  for (std::int32_t y = in_.y0; y < out.y1; ++y) {
    const std::ptrdiff_t first = std::ptrdiff_t{y} * cells.width + in_.x0;
    count_row(cells.kinds + first, cells.obstacles, most, columns, run_.data());
    if (y >= out.y0)
      std::copy(run_.begin(), run_.end(),
                rows_up_.begin() + static_cast<std::ptrdiff_t>(columns) * (y - out.y0));
  }
  run_.assign(columns, most);
  // The row is padded so that a window of the reach around each cell, whole blocks of them, stays within it.
  const auto pad = static_cast<std::size_t>(reach_);
  vertical_.assign(columns + 2 * pad + kBlock, cap());
  gaps_.resize(static_cast<std::size_t>(out.width()) + kBlock);
}

/// True where the row is one of `out`: its gaps are there then.
bool GapScan::next_row(const ObstacleCells& cells, const CellRect& out, std::int32_t y) {
  const auto columns = static_cast<std::size_t>(in_.width());
  const auto most = static_cast<std::uint8_t>(reach_ + 1);
  count_row(cells.kinds + std::ptrdiff_t{y} * cells.width + in_.x0, cells.obstacles, most, columns,
            run_.data());
  if (y >= out.y1) return false;
  const std::uint8_t* const up = rows_up_.data() + columns * static_cast<std::size_t>(y - out.y0);
  fill_row({run_.data(), up, columns, vertical_.data() + reach_, static_cast<std::size_t>(out.x0 - in_.x0),
            static_cast<std::size_t>(out.width()), across_.data(), across_.size(), gaps_.data()});
  return true;
}

void GapField::reset(std::int32_t width, std::int32_t height, std::int32_t reach) {
  scan_ = GapScan(reach);
  gaps_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), cap());
}

void GapField::update(const ObstacleCells& cells, const CellRect& changed) {
  const CellRect out = changed.grown(reach()).clipped({0, 0, cells.width, cells.height});
  if (out.empty()) return;
  scan_.scan(cells, out, [&](std::int32_t y, const std::int16_t* row) {
    std::copy(row, row + out.width(), gaps_.data() + std::ptrdiff_t{y} * cells.width + out.x0);
  });
}

}  // namespace floornav
