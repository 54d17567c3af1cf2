#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "mapping/map_tile.hpp"

namespace floornav {

/// All tiles of the mapper's memory, linked to their neighbours. Those far from the robot rest: packed into a
/// few bytes a cell, out of everybody's sight until they are woken.
class MapTiles {
 public:
  /// Before the first tile: how many lattice cells a vertex has along its side.
  void set_cells_per_vertex(std::int32_t cells) { cells_per_vertex_ = cells; }
  [[nodiscard]] std::int32_t cells_per_vertex() const { return cells_per_vertex_; }

  /// Null where there is none, or it rests.
  [[nodiscard]] MapTile* find(CellIndex tile) const;
  /// Made where there is none yet, for heights around `level_m`; not for one that rests.
  MapTile& make(CellIndex tile, double level_m);
  void clear();

  /// Packs the tiles that lie wholly outside of a circle and have no evidence that is not judged yet.
  void rest_outside(const Eigen::Vector2d& center_m, double radius_m, double resolution_m);
  /// Unpacks the resting tiles that touch a circle. Returns them sorted; their vertices are still to be
  /// summarised.
  std::vector<MapTile*> wake_within(const Eigen::Vector2d& center_m, double radius_m, double resolution_m);
  /// All of them; what was the robot's floor is asked anew.
  std::vector<MapTile*> wake_all();
  [[nodiscard]] bool is_resting(CellIndex tile) const { return resting_.contains(tile); }
  /// Those that do not rest, sorted.
  [[nodiscard]] std::vector<CellIndex> awake() const;
  /// Every tile's memory, resting or not, in order.
  [[nodiscard]] std::vector<std::pair<CellIndex, std::vector<std::uint8_t>>> packed() const;
  /// Adds a tile that rests. Throws std::invalid_argument for bytes that are no tile's, or a tile that
  /// exists.
  void add_resting(CellIndex tile, std::vector<std::uint8_t> bytes);

  [[nodiscard]] CellIndex vertex_of(CellIndex cell) const {
    return {block_of(cell.ix, cells_per_vertex_), block_of(cell.iy, cells_per_vertex_)};
  }
  /// Place of a lattice cell in MapTile::cells of its vertex's tile.
  [[nodiscard]] std::size_t slot_of(CellIndex cell) const;
  /// The lattice cell at a place in a tile's MapTile::cells.
  [[nodiscard]] CellIndex cell_at(const MapTile& tile, std::size_t slot) const;
  /// Nothing remembered where there is no tile.
  [[nodiscard]] CellMemory cell(CellIndex cell) const;
  /// False where there is no tile.
  [[nodiscard]] VertexRef find_vertex(CellIndex vertex) const;

  [[nodiscard]] std::int64_t memory_bytes() const;

 private:
  std::int32_t cells_per_vertex_ = 1;
  [[nodiscard]] std::size_t cells_per_tile() const {
    return static_cast<std::size_t>(cells_per_vertex_) * static_cast<std::size_t>(cells_per_vertex_) *
           GridTile::kVertices;
  }
  MapTile& add(CellIndex tile);
  MapTile& wake(CellIndex tile);

  std::unordered_map<CellIndex, std::unique_ptr<MapTile>> tiles_;
  std::unordered_map<CellIndex, std::vector<std::uint8_t>> resting_;
  mutable MapTile* last_found_ = nullptr;  ///< neighbouring cells ask for the same tile
};

}  // namespace floornav
