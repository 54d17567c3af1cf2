#include "tools/simulate/true_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace floornav {
namespace {

bool drivable(const TruthGrid& truth, std::int32_t x, std::int32_t y) {
  return x >= 0 && y >= 0 && x < truth.width && y < truth.height &&
         truth.cells[static_cast<std::size_t>(y * truth.width + x)].drivable;
}

std::uint8_t open_edges(const TruthGrid& truth, std::int32_t x, std::int32_t y) {
  std::uint8_t edges = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::int32_t dx = kNeighbourX[k];
    const std::int32_t dy = kNeighbourY[k];
    if (drivable(truth, x + dx, y + dy) && drivable(truth, x + dx, y) && drivable(truth, x, y + dy))
      edges = static_cast<std::uint8_t>(edges | 1U << k);
  }
  return edges;
}

std::int16_t counts(float height_m) {
  using Limits = std::numeric_limits<std::int16_t>;
  return static_cast<std::int16_t>(std::clamp(std::round(height_m / GridTile::kHeightUnit_m),
                                              static_cast<float>(Limits::min()),
                                              static_cast<float>(Limits::max())));
}

}  // namespace

GridMap true_map(const TruthGrid& truth) {
  GridMap map(truth.lattice.pitch_m);
  map.version = 1;
  for (std::int32_t y = 0; y < truth.height; ++y) {
    for (std::int32_t x = 0; x < truth.width; ++x) {
      const TruthCell& cell = truth.cells[static_cast<std::size_t>(y * truth.width + x)];
      const CellIndex vertex{truth.origin.ix + x, truth.origin.iy + y};
      GridTile& tile = map.make(GridMap::tile_of(vertex));
      tile.version = map.version;
      const auto i = static_cast<std::size_t>(GridTile::index_of(vertex));
      tile.state[i] = cell.drivable ? VertexState::kFree : VertexState::kBlocked;
      tile.belief[i] = cell.drivable ? 255 : 0;
      tile.height[i] = counts(cell.drivable ? cell.height_m : cell.highest_m);
      tile.seen.set(i, GridTile::Seen::at(1));
      if (cell.drivable) tile.edges[i] = open_edges(truth, x, y);
    }
  }
  return map;
}

}  // namespace floornav
