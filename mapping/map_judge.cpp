#include "mapping/map_judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "mapping/belief.hpp"
#include "mapping/floor_seeds.hpp"
#include "mapping/robot_limits.hpp"

namespace floornav {
namespace {

template <class Value>
bool assign(Value& slot, Value value) {
  const bool differs = slot != value;
  slot = value;
  return differs;
}

template <class Stored>
Stored quantised(float value, float unit) {
  using Limits = std::numeric_limits<Stored>;
  const float counts = std::round(value / unit);
  return static_cast<Stored>(
      std::clamp(counts, static_cast<float>(Limits::min()), static_cast<float>(Limits::max())));
}

std::uint8_t clearance_of(const Vertex& vertex, float floor_m) {
  if (std::isnan(vertex.overhead_z_m)) return GridTile::kNothingAbove;
  const auto counts = quantised<std::uint8_t>(vertex.overhead_z_m - floor_m, GridTile::kClearanceUnit_m);
  return std::min<std::uint8_t>(counts, GridTile::kNothingAbove - 1);
}

/// Writes what a vertex that was seen shows. True where it differs from before.
bool write_seen(GridTile& grid, std::size_t i, const Vertex& vertex, float belief, float slope) {
  const Surface& surface = vertex.surface;
  const float height_m = surface.z_m - grid.origin_z_m;
  bool differs = assign(grid.state[i], vertex.is(Vertex::kFree) ? VertexState::kFree : VertexState::kBlocked);
  differs |= assign(grid.belief[i], quantised<std::uint8_t>(belief, 1.0F / 255.0F));
  differs |= assign(grid.height[i], quantised<std::int16_t>(height_m, GridTile::kHeightUnit_m));
  differs |=
      assign(grid.sigma[i], quantised<std::int16_t>(std::sqrt(surface.var_m2), GridTile::kHeightUnit_m));
  differs |= assign(grid.slope[i], quantised<std::uint8_t>(slope, GridTile::kSlopeUnit_deg));
  return differs;
}

/// Writes a vertex that was never seen: unknown, or a drop beside the floor.
bool write_unseen(GridTile& grid, std::size_t i, bool drop, float floor_m) {
  constexpr std::int16_t kNoIdea = std::numeric_limits<std::int16_t>::max();
  const float height_m = drop ? floor_m - grid.origin_z_m : 0.0F;
  bool differs = assign(grid.state[i], drop ? VertexState::kBlocked : VertexState::kUnknown);
  differs |= assign(grid.belief[i], std::uint8_t{0});
  differs |= assign(grid.height[i], quantised<std::int16_t>(height_m, GridTile::kHeightUnit_m));
  differs |= assign(grid.sigma[i], drop ? kNoIdea : std::int16_t{0});
  differs |= assign(grid.slope[i], std::uint8_t{0});
  return differs;
}

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
      reach_(rule_.max_step_m, rule_.resolution_m, static_cast<float>(steepest_rise(robot))),
      floor_(settings.resolution_m),
      min_belief_(static_cast<float>(settings.min_belief > 0 ? settings.min_belief : least_belief(robot))),
      max_rise_(static_cast<float>(steepest_rise(robot))) {}

bool MapJudge::summarise_touched(MapTile& tile, std::int32_t cells_per_vertex) const {
  const std::size_t per_vertex = tile.cells.size() / tile.vertices.size();
  std::vector<CellMemory> cells(per_vertex);
  bool differs = tile.grid == nullptr;
  for (std::size_t i = 0; i < tile.vertices.size(); ++i) {
    if (!tile.touched[i]) continue;
    for (std::size_t c = 0; c < per_vertex; ++c) cells[c] = tile.cells.at(i * per_vertex + c);
    differs |= take_summary(cells, cells_per_vertex, tile.vertices[i]);
    if (tile.grid != nullptr) tile.grid->seen[i] = tile.vertices[i].seen;
  }
  tile.touched.reset();
  return differs;
}

bool MapJudge::take_summary(std::span<const CellMemory> cells, std::int32_t side, Vertex& vertex) const {
  const Vertex before = vertex;
  std::int32_t no_return_frames = 0;
  float overhead_z_m = std::numeric_limits<float>::quiet_NaN();
  for (const CellMemory& cell : cells) {
    overhead_z_m = std::fmin(overhead_z_m, cell.overhead_z_m());
    no_return_frames = std::max(no_return_frames, cell.no_return_frames());
  }
  const float pitch_m = rule_.resolution_m / static_cast<float>(side);
  const SquareSummary summary = summarise(cells, side, pitch_m, rule_.max_step_m);
  const bool gentle = std::hypot(summary.surface.gradient_x, summary.surface.gradient_y) <= max_rise_;
  vertex.set(Vertex::kSeen, summary.seen);
  vertex.set(Vertex::kDrivable, summary.seen && gentle && !summary.stepped && !summary.surface.column);
  vertex.set(Vertex::kNoReturn, !summary.seen && no_return_frames >= settings_.no_return_frames);
  const bool same_overhead =
      overhead_z_m == before.overhead_z_m || (std::isnan(overhead_z_m) && std::isnan(before.overhead_z_m));
  vertex.overhead_z_m = overhead_z_m;
  if (vertex.flags == before.flags && same_overhead &&
      !(summary.seen && differs_noticeably(summary.surface, before.surface)))
    return false;
  vertex.surface = summary.surface;
  return true;
}

bool MapJudge::judge_vertex(const VertexRef& place, float floor_m) {
  Vertex& vertex = place.vertex();
  GridTile& grid = *place.tile->grid;
  const std::size_t i = place.index();
  grid.seen[i] = vertex.seen;
  bool differs = assign(grid.clearance[i], clearance_of(vertex, floor_m));
  if (!vertex.is(Vertex::kSeen)) {
    vertex.set(Vertex::kFree, false);
    const bool drop = vertex.is(Vertex::kNoReturn) && FloorReach::beside_floor(place);
    return write_unseen(grid, i, drop, floor_m) || differs;
  }
  const float slope = slope_deg(vertex.surface);
  const float belief_here = belief(vertex.surface.z_m - floor_m, slope);
  const bool believed = belief_here >= min_belief_;
  vertex.set(Vertex::kFree, believed && vertex.is(Vertex::kDrivable) && !vertex.is(Vertex::kCutOff) &&
                                !is_rim(place, rule_));
  return write_seen(grid, i, vertex, belief_here, slope) || differs;
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
  return differs;
}

bool MapJudge::publish_edges(MapTile& tile) const {
  bool differs = false;
  for (std::int32_t y = 0; y < MapTile::kSide; ++y) {
    for (std::int32_t x = 0; x < MapTile::kSide; ++x) {
      const VertexRef place{&tile, x, y};
      std::uint8_t& edges = tile.grid->edges[place.index()];
      differs |= assign(edges, open_edges(place, rule_, edges));
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
    tile->grid = &map.make(tile->index);
    if (judge(*tile, T_world_body)) changed.push_back(tile->index);
  }
  add_neighbours(work, version);
  for (MapTile* tile : work)
    if (publish_edges(*tile)) changed.push_back(tile->index);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const CellIndex index : changed) map.make(index).version = version;
  return changed;
}

}  // namespace floornav
