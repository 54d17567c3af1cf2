#include "mapping/map_tiles.hpp"

namespace floornav {

MapTile* MapTiles::find(CellIndex tile) const {
  if (last_found_ != nullptr && last_found_->index == tile) return last_found_;
  const auto it = tiles_.find(tile);
  if (it == tiles_.end()) return nullptr;
  last_found_ = it->second.get();
  return last_found_;
}

MapTile& MapTiles::make(CellIndex tile) {
  if (MapTile* const known = find(tile)) return *known;
  auto& slot = tiles_[tile];
  slot = std::make_unique<MapTile>();
  slot->index = tile;
  const auto per_vertex =
      static_cast<std::size_t>(cells_per_vertex_) * static_cast<std::size_t>(cells_per_vertex_);
  slot->cells.resize(per_vertex * GridTile::kVertices);
  for (std::size_t k = 0; k < 8; ++k) {
    MapTile* const beside = find({tile.ix + kNeighbourX[k], tile.iy + kNeighbourY[k]});
    if (beside == nullptr) continue;
    slot->neighbours[k] = beside;
    beside->neighbours[(k + 4) % 8] = slot.get();
  }
  return *slot;
}

std::size_t MapTiles::slot_of(CellIndex cell) const {
  const CellIndex vertex = vertex_of(cell);
  const auto side = static_cast<std::size_t>(cells_per_vertex_);
  const auto x = static_cast<std::size_t>(cell.ix - vertex.ix * cells_per_vertex_);
  const auto y = static_cast<std::size_t>(cell.iy - vertex.iy * cells_per_vertex_);
  return (GridMap::index_of(vertex) * side + y) * side + x;
}

CellIndex MapTiles::cell_at(const MapTile& tile, std::size_t slot) const {
  const std::int32_t side = cells_per_vertex_;
  const auto place = static_cast<std::int32_t>(slot);
  const std::int32_t vertex = place / (side * side);
  const std::int32_t within = place % (side * side);
  return {(tile.index.ix * MapTile::kSide + vertex % MapTile::kSide) * side + within % side,
          (tile.index.iy * MapTile::kSide + vertex / MapTile::kSide) * side + within / side};
}

const CellMemory* MapTiles::find_cell(CellIndex cell) const {
  const MapTile* const tile = find(GridMap::tile_of(vertex_of(cell)));
  return tile ? &tile->cells[slot_of(cell)] : nullptr;
}

VertexRef MapTiles::find_vertex(CellIndex vertex) const {
  const CellIndex index = GridMap::tile_of(vertex);
  return {find(index), vertex.ix - index.ix * MapTile::kSide, vertex.iy - index.iy * MapTile::kSide};
}

std::int64_t MapTiles::memory_bytes() const {
  std::int64_t sum = 0;
  for (const auto& [index, tile] : tiles_) sum += tile->memory_bytes();
  return sum;
}

}  // namespace floornav
