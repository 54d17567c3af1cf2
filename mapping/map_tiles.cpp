#include "mapping/map_tiles.hpp"

#include <algorithm>
#include <stdexcept>

#include "mapping/tile_codec.hpp"

namespace floornav {
namespace {

double distance_m(CellIndex tile, const Eigen::Vector2d& place_m, double side_m) {
  const Eigen::Vector2d low(tile.ix * side_m, tile.iy * side_m);
  const Eigen::Vector2d high = low + Eigen::Vector2d::Constant(side_m);
  return (place_m.cwiseMax(low).cwiseMin(high) - place_m).norm();
}

/// Takes a tile out of its neighbours' sight.
void part(const MapTile& tile) {
  for (std::size_t k = 0; k < 8; ++k)
    if (tile.neighbours[k] != nullptr) tile.neighbours[k]->neighbours[(k + 4) % 8] = nullptr;
}

}  // namespace

MapTile* MapTiles::find(CellIndex tile) const {
  if (last_found_ != nullptr && last_found_->index == tile) return last_found_;
  const auto it = tiles_.find(tile);
  if (it == tiles_.end()) return nullptr;
  last_found_ = it->second.get();
  return last_found_;
}

MapTile& MapTiles::make(CellIndex tile, double level_m) {
  if (MapTile* const known = find(tile)) return *known;
  MapTile& made = add(tile);
  made.cells = CellStore(cells_per_tile(), level_m);
  return made;
}

MapTile& MapTiles::add(CellIndex tile) {
  auto& slot = tiles_[tile];
  slot = std::make_unique<MapTile>();
  slot->index = tile;
  if (cells_per_vertex_ > 1) slot->surfaces.resize(GridTile::kVertices);
  for (std::size_t k = 0; k < 8; ++k) {
    MapTile* const beside = find({tile.ix + kNeighbourX[k], tile.iy + kNeighbourY[k]});
    if (beside == nullptr) continue;
    slot->neighbours[k] = beside;
    beside->neighbours[(k + 4) % 8] = slot.get();
  }
  return *slot;
}

void MapTiles::clear() {
  last_found_ = nullptr;
  tiles_.clear();
  resting_.clear();
}

MapTile& MapTiles::wake(CellIndex tile) {
  const std::vector<std::uint8_t> bytes = std::move(resting_.extract(tile).mapped());
  MapTile& woken = add(tile);
  unpack(bytes, cells_per_tile(), woken);
  woken.touched.set();
  woken.floor_is_known = true;
  return woken;
}

void MapTiles::rest_outside(const Eigen::Vector2d& center_m, double radius_m, double resolution_m) {
  last_found_ = nullptr;
  std::erase_if(tiles_, [&](const auto& entry) {
    const MapTile& tile = *entry.second;
    if (tile.touched.any() || distance_m(tile.index, center_m, resolution_m * MapTile::kSide) <= radius_m)
      return false;
    part(tile);
    resting_[tile.index] = pack(tile);
    return true;
  });
}

std::vector<MapTile*> MapTiles::wake_within(const Eigen::Vector2d& center_m, double radius_m,
                                            double resolution_m) {
  std::vector<MapTile*> woken;
  if (resting_.empty()) return woken;
  const double side_m = resolution_m * MapTile::kSide;
  const Lattice lattice{side_m};
  const CellIndex first = lattice.cell_of(center_m.x() - radius_m, center_m.y() - radius_m);
  const CellIndex last = lattice.cell_of(center_m.x() + radius_m, center_m.y() + radius_m);
  for (std::int32_t ix = first.ix; ix <= last.ix; ++ix)
    for (std::int32_t iy = first.iy; iy <= last.iy; ++iy)
      if (is_resting({ix, iy}) && distance_m({ix, iy}, center_m, side_m) <= radius_m)
        woken.push_back(&wake({ix, iy}));
  return woken;
}

std::vector<CellIndex> MapTiles::awake() const {
  std::vector<CellIndex> sorted;
  for (const auto& [index, tile] : tiles_) sorted.push_back(index);
  std::ranges::sort(sorted);
  return sorted;
}

std::vector<MapTile*> MapTiles::wake_all() {
  std::vector<CellIndex> sorted;
  for (const auto& [index, bytes] : resting_) sorted.push_back(index);
  std::ranges::sort(sorted);
  std::vector<MapTile*> woken;
  for (const CellIndex index : sorted) {
    woken.push_back(&wake(index));
    woken.back()->floor_is_known = false;
  }
  return woken;
}

std::vector<std::pair<CellIndex, std::vector<std::uint8_t>>> MapTiles::packed() const {
  std::vector<std::pair<CellIndex, std::vector<std::uint8_t>>> all(resting_.begin(), resting_.end());
  for (const auto& [index, tile] : tiles_) all.emplace_back(index, pack(*tile));
  std::ranges::sort(all, {}, [](const auto& entry) { return entry.first; });
  return all;
}

void MapTiles::add_resting(CellIndex tile, std::vector<std::uint8_t> bytes) {
  if (find(tile) != nullptr || is_resting(tile)) throw std::invalid_argument("the same tile twice");
  MapTile trial;
  unpack(bytes, cells_per_tile(), trial);
  resting_[tile] = std::move(bytes);
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

CellMemory MapTiles::cell(CellIndex cell) const {
  const MapTile* const tile = find(GridMap::tile_of(vertex_of(cell)));
  return tile ? tile->cells.at(slot_of(cell)) : CellMemory{};
}

VertexRef MapTiles::find_vertex(CellIndex vertex) const {
  const CellIndex index = GridMap::tile_of(vertex);
  return {find(index), vertex.ix - index.ix * MapTile::kSide, vertex.iy - index.iy * MapTile::kSide};
}

std::int64_t MapTiles::memory_bytes() const {
  std::int64_t sum = 0;
  constexpr std::size_t kEntry = 64;  // of the hash maps
  for (const auto& [index, tile] : tiles_) sum += tile->memory_bytes() + static_cast<std::int64_t>(kEntry);
  for (const auto& [index, bytes] : resting_) sum += static_cast<std::int64_t>(bytes.capacity() + kEntry);
  return sum;
}

}  // namespace floornav
