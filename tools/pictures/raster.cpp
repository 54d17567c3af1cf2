#include "tools/pictures/raster.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

namespace {

/// Calls `take(cell)` for every cell of the map's tiles.
template <class Tile, class Take>
void for_each_cell(const TileMap<Tile>& map, Take take) {
  for (const auto& [place, tile] : map.tiles())
    for (std::int32_t row = 0; row < Tile::kSide; ++row)
      for (std::int32_t column = 0; column < Tile::kSide; ++column)
        take(CellIndex{place.ix * Tile::kSide + column, place.iy * Tile::kSide + row});
}

}  // namespace

void CellBounds::add(CellIndex cell) {
  if (empty_) least_ = most_ = cell;
  empty_ = false;
  least_ = {std::min(least_.ix, cell.ix), std::min(least_.iy, cell.iy)};
  most_ = {std::max(most_.ix, cell.ix), std::max(most_.iy, cell.iy)};
}

CellRectangle CellBounds::rectangle(double resolution_m) const {
  return {resolution_m, least_, most_.ix - least_.ix + 1, most_.iy - least_.iy + 1};
}

MapRaster rasterize(const GridMap& map) {
  CellBounds seen;
  for_each_cell(map, [&](CellIndex cell) {
    if (map.state(cell) != VertexState::kUnknown) seen.add(cell);
  });
  return rasterize(map, seen.rectangle(map.lattice().pitch_m));
}

MapRaster rasterize(const GridMap& map, const CellRectangle& cells) {
  MapRaster raster{cells, {}, {}, {}};
  raster.state.assign(cells.size(), VertexState::kUnknown);
  raster.belief.assign(cells.size(), 0);
  raster.height_m.assign(cells.size(), std::numeric_limits<float>::quiet_NaN());
  std::size_t at = 0;
  for (std::int32_t iy = cells.first.iy; iy < cells.first.iy + cells.height; ++iy)
    for (std::int32_t ix = cells.first.ix; ix < cells.first.ix + cells.width; ++ix, ++at) {
      raster.state[at] = map.state({ix, iy});
      if (raster.state[at] == VertexState::kUnknown) continue;
      const GridTile& tile = *map.find(GridMap::tile_of({ix, iy}));
      const std::int32_t index = GridTile::index_of({ix, iy});
      raster.belief[at] = tile.belief[static_cast<std::size_t>(index)];
      raster.height_m[at] = tile.height_m(index);
    }
  return raster;
}

HeightRaster rasterize(const TerrainMap& map) {
  CellBounds seen;
  for_each_cell(map, [&](CellIndex cell) {
    if (!std::isnan(map.height_m(cell))) seen.add(cell);
  });
  HeightRaster raster{seen.rectangle(map.lattice().pitch_m), {}};
  raster.height_m.reserve(raster.cells.size());
  for (std::int32_t row = 0; row < raster.cells.height; ++row)
    for (std::int32_t column = 0; column < raster.cells.width; ++column)
      raster.height_m.push_back(map.height_m({raster.cells.first.ix + column, raster.cells.first.iy + row}));
  return raster;
}

}  // namespace floornav
