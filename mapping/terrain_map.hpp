#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "mapping/tile_map.hpp"

namespace floornav {

/// A square of heights of all that was seen, whether it can be driven on or not (section VI).
struct TerrainTile {
  static constexpr std::int32_t kSide = 32;
  static constexpr std::int32_t kCells = kSide * kSide;
  static constexpr float kHeightUnit_m = 1e-3F;
  static constexpr std::int16_t kUnknown = std::numeric_limits<std::int16_t>::min();

  TerrainTile() { height.fill(kUnknown); }

  std::int64_t version = 0;                 ///< map version at which it last changed
  float origin_z_m = 0;                     ///< added to heights
  std::array<std::int16_t, kCells> height;  ///< kHeightUnit_m above origin_z_m; kUnknown: never seen
};

/// The dense height map, at its own resolution.
class TerrainMap : public TileMap<TerrainTile> {
 public:
  explicit TerrainMap(double resolution_m = 0.2) : TileMap(resolution_m) {}

  /// z in the local world frame, m; NaN where nothing was seen.
  [[nodiscard]] float height_m(CellIndex cell) const {
    const TerrainTile* tile = find(tile_of(cell));
    const std::int16_t height = tile ? tile->height[index_of(cell)] : TerrainTile::kUnknown;
    if (height == TerrainTile::kUnknown) return std::numeric_limits<float>::quiet_NaN();
    return tile->origin_z_m + TerrainTile::kHeightUnit_m * static_cast<float>(height);
  }
};

}  // namespace floornav
