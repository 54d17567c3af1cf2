#include "mapping/map_judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "mapping/belief.hpp"
#include "mapping/floor_seeds.hpp"
#include "mapping/published_vertex.hpp"
#include "mapping/robot_limits.hpp"
#include "mapping/told_height.hpp"

namespace floornav {
namespace {

/// Appends the tiles around those in `work` that are not in it.
void add_neighbours(std::vector<MapTile*>& work, std::int64_t version) {
  for (std::size_t i = 0, end = work.size(); i < end; ++i) {
    for (MapTile* beside : work[i]->neighbours) {
      if (beside == nullptr || beside->judged == version) continue;
      beside->judged = version;
      work.push_back(beside);
    }
  }
}

/// The way by which the robot came to a tile's floor may rest.
void add_known_floor(MapTile& tile, std::vector<VertexRef>& seeds) {
  if (!std::exchange(tile.floor_is_known, false)) return;
  for (std::int32_t y = 0; y < MapTile::kSide; ++y) {
    for (std::int32_t x = 0; x < MapTile::kSide; ++x) {
      const VertexRef place{&tile, x, y};
      if (place.vertex().is(Vertex::kFloor) && place.vertex().is(Vertex::kDrivable)) seeds.push_back(place);
    }
  }
}

}  // namespace

MapJudge::MapJudge(const MappingSettings& settings, const RobotSettings& robot)
    : settings_(settings),
      rule_{static_cast<float>(step_limit_m(robot)), static_cast<float>(settings.resolution_m)},
      reach_(rule_, static_cast<float>(steepest_rise(robot))),
      floor_(settings.resolution_m),
      min_belief_(static_cast<float>(settings.min_belief > 0 ? settings.min_belief : least_belief(robot))),
      max_rise_(static_cast<float>(steepest_rise(robot))) {}

bool MapJudge::summarise_touched(MapTile& tile, std::int32_t cells_per_vertex) const {
  const std::size_t per_vertex = tile.cells.size() / tile.vertices.size();
  std::vector<CellMemory> cells(per_vertex);
  bool differs = std::exchange(tile.overhead_moved, false) || tile.grid == nullptr;
  for (std::size_t i = 0; i < tile.vertices.size(); ++i) {
    if (!tile.touched[i]) continue;
    for (std::size_t c = 0; c < per_vertex; ++c) cells[c] = tile.cells.at(i * per_vertex + c);
    differs |= take_summary(cells, cells_per_vertex, tile, i);
  }
  tile.touched.reset();
  return differs;
}

bool MapJudge::take_summary(std::span<const CellMemory> cells, std::int32_t side, MapTile& tile,
                            std::size_t i) const {
  Vertex& vertex = tile.vertices[i];
  const std::uint8_t flags_before = vertex.flags;
  std::int32_t doubt = 0;
  for (const CellMemory& cell : cells) doubt = std::max(doubt, cell.floor_doubt());
  const float pitch_m = rule_.resolution_m / static_cast<float>(side);
  const SquareSummary summary = summarise(cells, side, pitch_m, rule_.max_step_m);
  const bool gentle = std::hypot(summary.surface.gradient_x, summary.surface.gradient_y) <= max_rise_;
  vertex.set(Vertex::kSeen, summary.seen);
  vertex.set(Vertex::kStepped, summary.stepped);
  vertex.set(Vertex::kDrivable, summary.seen && gentle && !summary.stepped && !summary.surface.column);
  vertex.set(Vertex::kFloorEnds, doubt >= (summary.seen ? CellMemory::kOnEdge : settings_.no_return_frames));
  if (!tile.surfaces.empty()) tile.surfaces[i] = summary.surface;
  if (vertex.flags != flags_before || tile.grid == nullptr) return true;
  if (!summary.seen) return false;
  const auto at = static_cast<std::int32_t>(i);
  const VertexRef place{&tile, at % MapTile::kSide, at / MapTile::kSide};
  return differs_noticeably(told(place), slope_deg(summary.surface), *tile.grid, i);
}

/// What is told of a vertex that was seen.
Surface MapJudge::told(const VertexRef& place) const {
  if (place.vertex().is(Vertex::kFree)) return place.surface();
  return highest_place(place, rule_.resolution_m, rule_.max_step_m);
}

bool MapJudge::judge_vertex(const VertexRef& place, float floor_m) {
  Vertex& vertex = place.vertex();
  GridTile& grid = *place.tile->grid;
  const std::size_t i = place.index();
  bool differs = publish_clearance(place.tile->overhead_z_m(i), floor_m, grid, i);
  if (!vertex.is(Vertex::kSeen)) {
    vertex.set(Vertex::kFree, false);
    const bool drop = vertex.is(Vertex::kFloorEnds) && FloorReach::beside_floor(place);
    differs |= publish_unseen(drop, floor_m, grid, i);
    heights_[i] = grid.height[i];
    return differs;
  }
  const Surface surface = place.surface();
  const float slope = slope_deg(surface);
  const float belief_here = belief(surface.z_m - floor_m, slope);
  const bool believed = belief_here >= min_belief_;
  vertex.set(Vertex::kFree, believed && vertex.is(Vertex::kDrivable) &&
                                !vertex.is(Vertex::kCutOff | Vertex::kFloorEnds) && !is_rim(place, rule_));
  const Surface top = told(place);
  heights_[i] = height_code(top, grid);
  return publish_seen(top, slope, vertex.is(Vertex::kFree), belief_here, grid, i) || differs;
}

bool MapJudge::judge(MapTile& tile, const Pose& T_world_body) {
  const double side_m = settings_.resolution_m * MapTile::kSide;
  const float far_m =
      plane_height_m(T_world_body, (tile.index.ix + 0.5) * side_m, (tile.index.iy + 0.5) * side_m);
  floor_.heights_of(tile, far_m, floor_heights_m_);
  if (tile.grid->version == 0) tile.grid->origin_z_m = std::round(floor_heights_m_.front());
  bool differs = false;
  for (std::int32_t y = 0; y < MapTile::kSide; ++y) {
    for (std::int32_t x = 0; x < MapTile::kSide; ++x) {
      const VertexRef place{&tile, x, y};
      differs |= judge_vertex(place, floor_heights_m_[place.index()]);
    }
  }
  if (differs) tile.grid->height = heights_;
  return differs;
}

bool MapJudge::publish_edges(MapTile& tile) {
  bool differs = false;
  for (std::int32_t y = 0; y < MapTile::kSide; ++y) {
    for (std::int32_t x = 0; x < MapTile::kSide; ++x) {
      const VertexRef place{&tile, x, y};
      std::uint8_t& edges = tile.grid->edges[place.index()];
      const std::uint8_t before = std::exchange(edges, open_edges(place, tile.judged, edges));
      differs = differs || edges != before;
    }
  }
  return differs;
}

std::vector<CellIndex> MapJudge::refresh(const std::vector<CellIndex>& dirty, const Pose& T_world_body,
                                         MapTiles& tiles, GridMap& map) {
  const std::int64_t version = ++map.version;
  std::vector<MapTile*> work;
  for (const CellIndex index : dirty) {
    MapTile* const tile = tiles.find(index);
    if (!summarise_touched(*tile, tiles.cells_per_vertex())) continue;
    tile->judged = version;
    work.push_back(tile);
  }
  add_neighbours(work, version);
  for (MapTile* tile : work) open_steps(*tile, rule_);
  std::vector<VertexRef> seeds = floor_seeds(T_world_body, map.lattice(), rule_.max_step_m, tiles);
  for (MapTile* tile : work) add_known_floor(*tile, seeds);
  reach_.grow(work, seeds, version);
  reach_.find_cut_off(work, version);
  for (MapTile* tile : work) floor_.update(*tile);

  std::vector<CellIndex> changed;
  for (MapTile* tile : work) {
    tile->publish_in(map.make(tile->index));
    if (judge(*tile, T_world_body)) changed.push_back(tile->index);
  }
  const std::size_t judged = work.size();
  add_neighbours(work, version);
  for (MapTile* tile : std::span(work).subspan(judged)) open_steps(*tile, rule_);
  for (MapTile* tile : work)
    if (publish_edges(*tile)) changed.push_back(tile->index);
  for (MapTile* tile : work) tile->fold();
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const CellIndex index : changed) map.make(index).version = version;
  return changed;
}

}  // namespace floornav
