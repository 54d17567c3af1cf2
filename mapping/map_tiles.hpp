#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mapping/map_tile.hpp"

namespace floornav {

/// All tiles of the mapper's memory, linked to their neighbours.
class MapTiles {
 public:
  /// Before the first tile: how many lattice cells a vertex has along its side.
  void set_cells_per_vertex(std::int32_t cells) { cells_per_vertex_ = cells; }
  [[nodiscard]] std::int32_t cells_per_vertex() const { return cells_per_vertex_; }

  [[nodiscard]] MapTile* find(CellIndex tile) const;
  MapTile& make(CellIndex tile);
  void clear() {
    last_found_ = nullptr;
    tiles_.clear();
  }

  [[nodiscard]] CellIndex vertex_of(CellIndex cell) const {
    return {block_of(cell.ix, cells_per_vertex_), block_of(cell.iy, cells_per_vertex_)};
  }
  /// Place of a lattice cell in MapTile::cells of its vertex's tile.
  [[nodiscard]] std::size_t slot_of(CellIndex cell) const;
  /// The lattice cell at a place in a tile's MapTile::cells.
  [[nodiscard]] CellIndex cell_at(const MapTile& tile, std::size_t slot) const;
  /// Null where there is no tile.
  [[nodiscard]] const CellMemory* find_cell(CellIndex cell) const;
  /// False where there is no tile.
  [[nodiscard]] VertexRef find_vertex(CellIndex vertex) const;

  [[nodiscard]] std::int64_t memory_bytes() const;

 private:
  std::int32_t cells_per_vertex_ = 1;
  std::unordered_map<CellIndex, std::unique_ptr<MapTile>> tiles_;
  mutable MapTile* last_found_ = nullptr;  ///< neighbouring cells ask for the same tile
};

}  // namespace floornav
