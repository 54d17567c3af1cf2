#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mapping/map_tile.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// z of the plane under the robot (its body's x-y plane) at a place, m.
float plane_height_m(const Pose& T_world_body, double x_m, double y_m);

/// The height of the floor, against which section 4.6 measures what stands on it.
///
/// The floor is what the robot can drive to, not z = 0: a ramp and the storey at its top are floor. So in
/// blocks of about 0.8 m the median height of the robot's floor (Vertex::kFloor) is kept, and the height
/// anywhere is interpolated between the blocks' centres: a ramp is followed, while a lone bump or box, even
/// one that the floor seemed to climb, is measured against the floor around it. Where a block has no floor of
/// its own the blocks nearest to it tell, up to three blocks away; farther from any floor the plane under the
/// robot does.
class FloorHeight {
 public:
  explicit FloorHeight(double resolution_m);

  /// Takes the medians of the tile's blocks anew.
  void update(MapTile& tile);
  void clear() { blocks_.clear(); }
  [[nodiscard]] std::int64_t memory_bytes() const {
    return static_cast<std::int64_t>(blocks_.size() * (sizeof(*blocks_.begin()) + 2 * sizeof(void*)));
  }

  /// For every vertex of the tile in order, m. `far_from_floor_m`: where no floor is near.
  void heights_of(const MapTile& tile, float far_from_floor_m, std::vector<float>& heights_m) const;
  /// The block that holds a vertex.
  [[nodiscard]] CellIndex block_at(CellIndex vertex) const {
    return {block_of(vertex.ix, side_), block_of(vertex.iy, side_)};
  }
  /// Height of the floor in a block or around it, m; nothing where no floor is near.
  [[nodiscard]] std::optional<float> block_height(CellIndex block) const;

 private:
  std::int32_t side_;  ///< of a block, vertices
  std::unordered_map<CellIndex, float> blocks_;
};

}  // namespace floornav
