#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/clearances.hpp"
#include "mapping/seen_times.hpp"
#include "mapping/sigma_code.hpp"
#include "mapping/tile_map.hpp"
#include "mapping/vertex_states.hpp"
#include "runtime/geometry/lattice.hpp"

namespace floornav {

/// The eight neighbours of a vertex, counter-clockwise from +x: neighbour k is reached by (kNeighbourX[k],
/// kNeighbourY[k]).
inline constexpr std::array<std::int32_t, 8> kNeighbourX{1, 1, 0, -1, -1, -1, 0, 1};
inline constexpr std::array<std::int32_t, 8> kNeighbourY{0, 1, 1, 1, 0, -1, -1, -1};

/// A square of vertices as planner, viewer and messages share it (section 3.1). Vertex (i, j) has index j *
/// kSide + i.
struct GridTile {
  static constexpr std::int32_t kSide = 32;
  static constexpr std::int32_t kVertices = kSide * kSide;
  static constexpr float kHeightUnit_m = 1e-4F;
  static constexpr float kSlopeUnit_deg = 0.5F;
  static constexpr float kClearanceUnit_m = 0.01F;
  static constexpr std::uint8_t kNothingAbove = Clearances<kVertices>::kNothingAbove;
  using Seen = SeenTimes<kVertices>;

  std::int64_t version = 0;  ///< map version at which it last changed
  float origin_z_m = 0;      ///< added to heights
  VertexStates<kVertices> state;
  std::array<std::uint8_t, kVertices> belief{};  ///< 0..255 for 0..1, section 4.6
  std::array<std::int16_t, kVertices> height{};  ///< kHeightUnit_m above origin_z_m
  std::array<std::uint8_t, kVertices> sigma{};   ///< sigma_code() of kHeightUnit_m, 1 sigma of height
  std::array<std::uint8_t, kVertices> slope{};   ///< kSlopeUnit_deg
  Clearances<kVertices> clearance;               ///< kClearanceUnit_m of free height, kNothingAbove: open
  std::array<std::uint8_t, kVertices> edges{};   ///< bit k: the edge to neighbour k is open, eq. (2)
  Seen seen;                                     ///< of the last evidence

  static constexpr std::int32_t index_of(CellIndex cell) {
    return (cell.iy - block_of(cell.iy, kSide) * kSide) * kSide +
           (cell.ix - block_of(cell.ix, kSide) * kSide);
  }
  [[nodiscard]] float height_m(std::int32_t index) const {
    return origin_z_m + kHeightUnit_m * static_cast<float>(height[static_cast<std::size_t>(index)]);
  }
};

/// The grid-map: tiles of vertices over the local world frame, made on demand.
class GridMap : public TileMap<GridTile> {
 public:
  explicit GridMap(double resolution_m = 0.05) : TileMap(resolution_m) {}

  /// kUnknown where there is no tile.
  [[nodiscard]] VertexState state(CellIndex cell) const {
    const GridTile* tile = find(tile_of(cell));
    return tile ? tile->state[index_of(cell)] : VertexState::kUnknown;
  }
};

}  // namespace floornav
