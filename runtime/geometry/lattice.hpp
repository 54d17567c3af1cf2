#pragma once

#include <cstdint>
#include <functional>

namespace floornav {

/// Index of a square cell of the world-anchored lattice or of a map.
struct CellIndex {
  std::int32_t ix = 0;
  std::int32_t iy = 0;
  friend bool operator==(const CellIndex&, const CellIndex&) = default;
  friend auto operator<=>(const CellIndex&, const CellIndex&) = default;
};

/// Squares anchored at the local frame's origin: cell (i, j) covers [i p, (i+1) p) x [j p, (j+1) p).
struct Lattice {
  double pitch_m = 0.05;

  [[nodiscard]] std::int32_t index_of(double coordinate_m) const;
  [[nodiscard]] CellIndex cell_of(double x_m, double y_m) const { return {index_of(x_m), index_of(y_m)}; }
  [[nodiscard]] double center_of(std::int32_t index) const { return (index + 0.5) * pitch_m; }
};

/// Rounds towards minus infinity: the index of the block of `size` indices that holds `index`.
constexpr std::int32_t block_of(std::int32_t index, std::int32_t size) {
  return index >= 0 ? index / size : -((-index - 1) / size) - 1;
}

}  // namespace floornav

template <>
struct std::hash<floornav::CellIndex> {
  std::size_t operator()(const floornav::CellIndex& c) const noexcept {
    const auto key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.ix)) << 32) |
                     static_cast<std::uint32_t>(c.iy);
    return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) ^ (key >> 29));
  }
};
