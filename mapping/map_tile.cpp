#include "mapping/map_tile.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace floornav {

void MapTile::unfold() {
  steps_open = std::make_unique<Steps>();
  if (!surfaces.empty()) return;
  surfaces.resize(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) surfaces[i] = cells.decider(i).value_or(Surface{});
}

void MapTile::fold() {
  steps_open.reset();
  if (cells.size() == vertices.size()) std::vector<Surface>().swap(surfaces);
}

float MapTile::overhead_z_m(std::size_t vertex) const {
  float lowest_m = std::numeric_limits<float>::quiet_NaN();
  if (!cells.has_more()) return lowest_m;
  const std::size_t per_vertex = cells.size() / vertices.size();
  for (std::size_t slot = vertex * per_vertex; slot < (vertex + 1) * per_vertex; ++slot)
    if (cells.has_more(slot)) lowest_m = std::fmin(lowest_m, cells.at(slot).overhead_z_m());
  return lowest_m;
}

GridTile::Seen& MapTile::seen() {
  if (grid != nullptr) return grid->seen;
  if (!seen_) seen_ = std::make_unique<GridTile::Seen>();
  return *seen_;
}

const GridTile::Seen& MapTile::seen() const {
  static const GridTile::Seen kNever;
  if (grid != nullptr) return grid->seen;
  return seen_ ? *seen_ : kNever;
}

void MapTile::publish_in(GridTile& tile) {
  grid = &tile;
  if (const auto own = std::exchange(seen_, nullptr)) grid->seen = *own;
}

}  // namespace floornav
