#include "mapping/terrain_builder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace floornav {
namespace {

std::int16_t stored_height(const SquareSummary& summary, float origin_z_m) {
  if (!summary.seen) return TerrainTile::kUnknown;
  const float counts = std::round((summary.surface.z_m - origin_z_m) / TerrainTile::kHeightUnit_m);
  constexpr auto kMost = static_cast<float>(std::numeric_limits<std::int16_t>::max());
  return static_cast<std::int16_t>(std::clamp(counts, -kMost, kMost));
}

}  // namespace

void TerrainBuilder::touch(CellIndex grid_tile, double grid_resolution_m, const TerrainMap& terrain) {
  const double side_m = grid_resolution_m * GridTile::kSide;
  const double edge_m = 0.5 * grid_resolution_m;
  const auto tile_at = [&](std::int32_t ix, std::int32_t iy, double inside_m) {
    return TerrainMap::tile_of(terrain.lattice().cell_of(ix * side_m + inside_m, iy * side_m + inside_m));
  };
  const CellIndex first = tile_at(grid_tile.ix, grid_tile.iy, edge_m);
  const CellIndex last = tile_at(grid_tile.ix + 1, grid_tile.iy + 1, -edge_m);
  for (std::int32_t iy = first.iy; iy <= last.iy; ++iy)
    for (std::int32_t ix = first.ix; ix <= last.ix; ++ix) touched_.push_back({ix, iy});
}

bool TerrainBuilder::summarise_tile(CellIndex index, const MapTiles& tiles, std::int32_t cells_per_height,
                                    float max_step_m, TerrainMap& terrain) {
  const auto pitch_m = static_cast<float>(terrain.lattice().pitch_m / cells_per_height);
  std::vector<CellMemory> cells;
  TerrainTile& tile = terrain.make(index);
  bool differs = false;
  for (std::int32_t i = 0; i < TerrainTile::kCells; ++i) {
    const std::int32_t ix = (index.ix * TerrainTile::kSide + i % TerrainTile::kSide) * cells_per_height;
    const std::int32_t iy = (index.iy * TerrainTile::kSide + i / TerrainTile::kSide) * cells_per_height;
    cells.clear();
    const auto rests = [&](std::int32_t x, std::int32_t y) {
      return tiles.is_resting(GridMap::tile_of(tiles.vertex_of({x, y})));
    };
    if (rests(ix, iy) || rests(ix + cells_per_height - 1, iy + cells_per_height - 1)) continue;
    for (std::int32_t c = 0; c < cells_per_height * cells_per_height; ++c)
      cells.push_back(tiles.cell({ix + c % cells_per_height, iy + c / cells_per_height}));
    const SquareSummary summary = summarise(cells, cells_per_height, pitch_m, max_step_m);
    if (tile.version == 0 && summary.seen && !differs) tile.origin_z_m = std::round(summary.surface.z_m);
    std::int16_t& height = tile.height[static_cast<std::size_t>(i)];
    const std::int16_t now = stored_height(summary, tile.origin_z_m);
    differs |= now != height;
    height = now;
  }
  return differs;
}

std::vector<CellIndex> TerrainBuilder::refresh(const MapTiles& tiles, std::int32_t cells_per_height,
                                               float max_step_m, TerrainMap& terrain) {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  std::vector<CellIndex> changed;
  for (const CellIndex index : touched_) {
    if (!summarise_tile(index, tiles, cells_per_height, max_step_m, terrain)) continue;
    terrain.make(index).version = terrain.version;
    changed.push_back(index);
  }
  touched_.clear();
  return changed;
}

}  // namespace floornav
