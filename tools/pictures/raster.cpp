#include "tools/pictures/raster.hpp"

#include <algorithm>

namespace floornav {

namespace {

/// Calls `take(cell, tile, index)` for every vertex that was seen.
template <class Take>
void for_each_known(const GridMap& map, Take take) {
  for (const auto& [place, tile] : map.tiles())
    for (std::int32_t index = 0; index < GridTile::kVertices; ++index) {
      if (tile->state[static_cast<std::size_t>(index)] == VertexState::kUnknown) continue;
      take(CellIndex{place.ix * GridTile::kSide + index % GridTile::kSide,
                     place.iy * GridTile::kSide + index / GridTile::kSide},
           *tile, index);
    }
}

}  // namespace

void Bounds::add(CellIndex cell) {
  if (empty_) least_ = most_ = cell;
  empty_ = false;
  least_ = {std::min(least_.ix, cell.ix), std::min(least_.iy, cell.iy)};
  most_ = {std::max(most_.ix, cell.ix), std::max(most_.iy, cell.iy)};
}

CellRectangle Bounds::rectangle(double resolution_m) const {
  return {resolution_m, least_, most_.ix - least_.ix + 1, most_.iy - least_.iy + 1};
}

MapRaster rasterize(const GridMap& map) {
  Bounds bounds;
  for_each_known(map, [&](CellIndex cell, const GridTile&, std::int32_t) { bounds.add(cell); });
  MapRaster raster;
  raster.cells = bounds.rectangle(map.lattice().pitch_m);
  raster.state.assign(raster.cells.size(), VertexState::kUnknown);
  raster.belief.assign(raster.cells.size(), 0);
  raster.height_m.assign(raster.cells.size(), std::numeric_limits<float>::quiet_NaN());
  for_each_known(map, [&](CellIndex cell, const GridTile& tile, std::int32_t index) {
    const std::size_t at = raster.cells.index_of(cell);
    raster.state[at] = tile.state[static_cast<std::size_t>(index)];
    raster.belief[at] = tile.belief[static_cast<std::size_t>(index)];
    raster.height_m[at] = tile.height_m(index);
  });
  return raster;
}

}  // namespace floornav
