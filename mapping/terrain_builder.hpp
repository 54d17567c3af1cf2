#pragma once

#include <vector>

#include "mapping/map_tiles.hpp"
#include "mapping/terrain_map.hpp"

namespace floornav {

/// Makes the terrain map out of the same memory as the grid-map, at its own resolution (section VI).
class TerrainBuilder {
 public:
  /// Notes that a grid tile has new evidence.
  void touch(CellIndex grid_tile, double grid_resolution_m, const TerrainMap& terrain);

  /// Summarises the noted tiles anew. `cells_per_height`: lattice cells along a terrain cell's side. Returns
  /// the terrain tiles that changed, sorted.
  std::vector<CellIndex> refresh(const MapTiles& tiles, std::int32_t cells_per_height, float max_step_m,
                                 TerrainMap& terrain);
  void clear() { touched_.clear(); }

 private:
  static bool summarise_tile(CellIndex index, const MapTiles& tiles, std::int32_t cells_per_height,
                             float max_step_m, TerrainMap& terrain);

  std::vector<CellIndex> touched_;
};

}  // namespace floornav
