#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "mapping/world_map.hpp"
#include "tests/mapping/made_evidence.hpp"

namespace floornav {

inline WorldMap mapped(const std::vector<FloorEvidence>& frames, MappingSettings settings = {},
                       RobotSettings robot = {}) {
  WorldMap map(settings, robot);
  for (const FloorEvidence& frame : frames) {
    map.integrate(frame);
    map.refresh();
  }
  return map;
}

struct Counts {
  int unknown = 0;
  int free = 0;
  int blocked = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

/// Vertices whose centres lie in the area.
template <class Visit>
void for_each_vertex(const WorldMap& map, const Area& area, Visit visit) {
  const Lattice& lattice = map.grid().lattice();
  for (std::int32_t iy = lattice.index_of(area.y_min_m) - 1; iy <= lattice.index_of(area.y_max_m) + 1; ++iy)
    for (std::int32_t ix = lattice.index_of(area.x_min_m) - 1; ix <= lattice.index_of(area.x_max_m) + 1; ++ix)
      if (inside(lattice.center_of(ix), lattice.center_of(iy), area)) visit(CellIndex{ix, iy});
}

inline Counts count(const WorldMap& map, const Area& area) {
  Counts counts;
  for_each_vertex(map, area, [&](CellIndex vertex) {
    const VertexState state = map.grid().state(vertex);
    ++(state == VertexState::kUnknown ? counts.unknown
       : state == VertexState::kFree  ? counts.free
                                      : counts.blocked);
  });
  return counts;
}

inline CellIndex at(const WorldMap& map, double x_m, double y_m) {
  return map.grid().lattice().cell_of(x_m, y_m);
}

inline const GridTile& tile_at(const WorldMap& map, CellIndex vertex) {
  return *map.grid().find(GridMap::tile_of(vertex));
}

inline float height_at(const WorldMap& map, double x_m, double y_m) {
  const CellIndex vertex = at(map, x_m, y_m);
  return tile_at(map, vertex).height_m(GridTile::index_of(vertex));
}

inline float belief_at(const WorldMap& map, double x_m, double y_m) {
  const CellIndex vertex = at(map, x_m, y_m);
  return static_cast<float>(tile_at(map, vertex).belief[GridMap::index_of(vertex)]) / 255.0F;
}

inline bool edge_open(const WorldMap& map, CellIndex vertex, std::size_t k) {
  const GridTile* tile = map.grid().find(GridMap::tile_of(vertex));
  return tile != nullptr && ((tile->edges[GridMap::index_of(vertex)] >> k) & 1U) != 0;
}

inline Scene ramp(double degrees, double from_m, double to_m) {
  const double rise = std::tan(degrees * std::numbers::pi / 180);
  return [=](double x_m, double) {
    const bool on = x_m > from_m && x_m < to_m;
    return Ground{rise * (std::clamp(x_m, from_m, to_m) - from_m), on ? rise : 0.0};
  };
}

}  // namespace floornav
