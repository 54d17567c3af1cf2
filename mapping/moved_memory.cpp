#include "mapping/moved_memory.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/map_tiles.hpp"
#include "mapping/tile_codec.hpp"

namespace floornav {
namespace {

/// A turn about z and a shift.
struct Motion {
  Eigen::Matrix2d turn;
  Eigen::Vector3d shift_m;

  explicit Motion(const Pose& pose)
      : turn(Eigen::Rotation2Dd(heading_of(pose)).toRotationMatrix()), shift_m(pose.translation()) {}
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& place_m) const {
    return turn * place_m + shift_m.head<2>();
  }
  [[nodiscard]] Eigen::Vector2d back(const Eigen::Vector2d& place_m) const {
    return turn.transpose() * (place_m - shift_m.head<2>());
  }
};

class MemoryMover {
 public:
  MemoryMover(const MapMemory& memory, const Pose& T_new_old) : lattice_{memory.pitch_m}, motion_(T_new_old) {
    before_.set_cells_per_vertex(memory.cells_per_vertex);
    after_.set_cells_per_vertex(memory.cells_per_vertex);
    for (const auto& [index, bytes] : memory.tiles) before_.add_resting(index, bytes);
  }

  std::vector<std::pair<CellIndex, std::vector<std::uint8_t>>> tiles() {
    for (const MapTile* tile : before_.wake_all()) make_tiles_under(*tile);
    std::vector<std::pair<CellIndex, std::vector<std::uint8_t>>> result;
    for (const CellIndex index : after_.awake()) {
      MapTile& tile = *after_.find(index);
      if (fill(tile)) result.emplace_back(index, pack(tile));
    }
    return result;
  }

 private:
  [[nodiscard]] Eigen::Vector2d center_m(CellIndex cell) const {
    return {lattice_.center_of(cell.ix), lattice_.center_of(cell.iy)};
  }
  [[nodiscard]] CellIndex cell_at(const Eigen::Vector2d& place_m) const {
    return lattice_.cell_of(place_m.x(), place_m.y());
  }

  /// The tiles that hold a place of this one, or lie beside such a tile.
  void make_tiles_under(const MapTile& tile) {
    const std::int32_t step = before_.cells_per_vertex() * MapTile::kSide / 2;
    const CellIndex first = before_.cell_at(tile, 0);
    for (std::int32_t y = 0; y <= 2; ++y) {
      for (std::int32_t x = 0; x <= 2; ++x) {
        const CellIndex cell{first.ix + x * step, first.iy + y * step};
        const CellIndex at = GridMap::tile_of(after_.vertex_of(cell_at(motion_(center_m(cell)))));
        for (std::int32_t dy = -1; dy <= 1; ++dy)
          for (std::int32_t dx = -1; dx <= 1; ++dx) after_.make({at.ix + dx, at.iy + dy}, 0);
      }
    }
  }

  [[nodiscard]] Level moved(Level level, const Eigen::Vector2d& from_center_m) const {
    level.z_m += static_cast<float>(motion_.shift_m.z());
    if (level.column) return level;
    const Eigen::Vector2d rise(level.gradient_x, level.gradient_y);
    level.z_m += static_cast<float>(rise.dot(from_center_m));
    const Eigen::Vector2d turned = motion_.turn * rise;
    level.gradient_x = static_cast<float>(turned.x());
    level.gradient_y = static_cast<float>(turned.y());
    return level;
  }

  /// False where nothing was known.
  bool fill(MapTile& tile) {
    bool known = false;
    std::vector<CellMemory> cells(tile.cells.size());
    const std::size_t per_vertex = tile.cells.size() / tile.vertices.size();
    for (std::size_t slot = 0; slot < tile.cells.size(); ++slot) {
      const Eigen::Vector2d place_m = motion_.back(center_m(after_.cell_at(tile, slot)));
      const CellIndex old = cell_at(place_m);
      const VertexRef old_vertex = before_.find_vertex(before_.vertex_of(old));
      if (!old_vertex) continue;
      const CellMemory cell = before_.cell(old);
      const Eigen::Vector2d from_center_m = place_m - center_m(old);
      cells[slot] = {moved(cell.lower(), from_center_m), moved(cell.upper(), from_center_m),
                     cell.overhead_z_m() + static_cast<float>(motion_.shift_m.z()), cell.floor_doubt()};
      const std::size_t vertex = slot / per_vertex;
      tile.seen().set(vertex, std::max(tile.seen()[vertex], old_vertex.tile->seen()[old_vertex.index()]));
      known = known || cell.lower().exists() || cell.floor_doubt() > 0;
    }
    tile.cells = CellStore(cells);
    return known;
  }

  Lattice lattice_;
  Motion motion_;
  MapTiles before_;
  MapTiles after_;
};

}  // namespace

MapMemory moved(const MapMemory& memory, const Pose& T_new_old) {
  MapMemory result = memory;
  result.T_world_body = T_new_old * memory.T_world_body;
  if (memory.pitch_m > 0) result.tiles = MemoryMover(memory, T_new_old).tiles();
  return result;
}

}  // namespace floornav
