// What a planning grid takes over from the map.

#include <algorithm>
#include <cmath>

#include "planner/planning_grid.hpp"

namespace floornav {
namespace {

constexpr std::int64_t kNoTile = -1;  ///< in place of a version

}  // namespace

/// Copies the tiles that are new, changed or gone; the rectangle that holds them.
CellRect PlanningGrid::take_changed_tiles(const GridMap& map) {
  CellRect changed;
  std::size_t slot = 0;
  for (std::int32_t y = 0; y < search_.height; y += GridTile::kSide) {
    for (std::int32_t x = 0; x < search_.width; x += GridTile::kSide, ++slot) {
      const GridTile* const tile = map.find(GridMap::tile_of({window_.x0 + x, window_.y0 + y}));
      const std::int64_t version = tile != nullptr ? tile->version : kNoTile;
      if (tile_versions_[slot] == version) continue;
      tile_versions_[slot] = version;
      take_tile(tile, x, y);
      changed = changed.joined({x, y, x + GridTile::kSide, y + GridTile::kSide});
    }
  }
  return changed;
}

void PlanningGrid::take_tile(const GridTile* tile, std::int32_t x0, std::int32_t y0) {
  std::size_t from = 0;
  for (std::int32_t y = y0; y < y0 + GridTile::kSide; ++y) {
    for (std::int32_t x = x0; x < x0 + GridTile::kSide; ++x, ++from) {
      const std::size_t to = search_.index({x, y});
      const VertexState state = tile != nullptr ? tile->state[from] : VertexState::kUnknown;
      if (state == VertexState::kUnknown) {
        set_floor(to, never_seen(x, y));
        map_edges_[to] = 0xFF;
        terrain_[to] = 0;
        continue;
      }
      set_floor(to, state == VertexState::kFree ? std::uint8_t{0} : kBlocked);
      map_edges_[to] = tile->edges[from];
      const double slope_deg = static_cast<double>(GridTile::kSlopeUnit_deg) * tile->slope[from];
      const double steepness =
          robot_.max_slope_deg > 0 ? std::min(slope_deg / robot_.max_slope_deg, 1.0) : 1.0;
      terrain_[to] = weight_of(settings_.belief_cost * (1.0 - tile->belief[from] / 255.0) +
                               settings_.slope_cost * steepness);
    }
  }
}

/// What a cell that was never seen is taken for.
std::uint8_t PlanningGrid::never_seen(std::int32_t x, std::int32_t y) const {
  if (within(assumed_, x, y)) return kAssumed;
  const bool shut =
      std::any_of(shut_.begin(), shut_.end(), [&](const AssumedFloor& c) { return within(c, x, y); });
  return shut ? kBlocked : kUnknown;
}

/// What that changed.
CellRect PlanningGrid::assume_floor_under(const AssumedFloor& robot) {
  const GridCell low = cell_of(robot.x_m - robot.radius_m, robot.y_m - robot.radius_m),
                 high = cell_of(robot.x_m + robot.radius_m, robot.y_m + robot.radius_m);
  const CellRect rect =
      CellRect{low.x, low.y, high.x + 1, high.y + 1}.clipped({0, 0, search_.width, search_.height});
  CellRect changed;
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      if (floor({x, y}) != Floor::kUnknown || !within(robot, x, y)) continue;
      set_floor(search_.index({x, y}), kAssumed);
      changed = changed.joined({x, y, x + 1, y + 1});
    }
  }
  return changed;
}
}  // namespace floornav
