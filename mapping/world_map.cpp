#include "mapping/world_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace floornav {
namespace {

/// As perception's settings have it: bounds the memory that the cells of one frame can ask for.
constexpr double kFinestPitch_m = 0.01;

/// How many lattice cells go along a side of `resolution_m`.
std::int32_t cells_along(double resolution_m, double pitch_m, const char* name) {
  const double ratio = resolution_m / pitch_m;
  const double cells = std::round(ratio);
  if (cells < 1 || std::abs(ratio - cells) > 1e-6 * cells)
    throw std::invalid_argument(std::string(name) + " " + std::to_string(resolution_m) +
                                " is no integer multiple of the lattice pitch " + std::to_string(pitch_m));
  return static_cast<std::int32_t>(cells);
}

/// The first frames of an epoch share their errors: the map's heights are those of their poses' mean. Later
/// ones are moved to the map, all but a fiftieth, so that it follows the poses slowly.
constexpr int kFramesToSettle = 30;
constexpr double kShareOfFrame = 0.98;
constexpr double kWakeTiles = 2;  ///< beyond the range of evidence: what is judged with it
constexpr double kRestTiles = 4;

}  // namespace

WorldMap::WorldMap(const MappingSettings& settings, const RobotSettings& robot)
    : alignment_(settings.alignment),
      max_range_m_(settings.max_range_m),
      memory_(settings, robot),
      judge_(settings, robot),
      grid_(settings.resolution_m),
      terrain_(settings.terrain_resolution_m) {}

void WorldMap::take_lattice(double pitch_m) {
  if (pitch_m == pitch_m_) return;
  if (!std::isfinite(pitch_m) || pitch_m < kFinestPitch_m)
    throw std::invalid_argument("absurd lattice pitch");
  if (pitch_m_ != 0)
    throw std::invalid_argument("lattice pitch changed from " + std::to_string(pitch_m_) + " to " +
                                std::to_string(pitch_m));
  const std::int32_t cells_per_vertex = cells_along(grid_.lattice().pitch_m, pitch_m, "resolution_m");
  cells_per_height_ = cells_along(terrain_.lattice().pitch_m, pitch_m, "terrain_resolution_m");
  tiles_.set_cells_per_vertex(cells_per_vertex);
  pitch_m_ = pitch_m;
}

WorldMemory::Taken WorldMap::integrate(const FloorEvidence& evidence) {
  take_lattice(evidence.lattice.pitch_m);
  if (!evidence.T_world_body.matrix().allFinite()) throw std::invalid_argument("pose that is not finite");
  wake_around(evidence.T_world_body);
  const HeightError error = settled_frames_ == 0
                                ? begin_level(find_level_error(evidence, alignment_))
                                : split_error(find_height_error(evidence, tiles_, alignment_));
  const WorldMemory::Taken taken = memory_.take(corrected(evidence, error), judge_.floor(), tiles_);
  if (evidence.utime_us >= utime_us_) T_world_body_ = evidence.T_world_body;
  utime_us_ = std::max(utime_us_, evidence.utime_us);
  return taken;
}

std::vector<CellIndex> WorldMap::refresh() {
  const std::vector<CellIndex> dirty = memory_.take_touched();
  for (const CellIndex tile : dirty) terrain_builder_.touch(tile, grid_.lattice().pitch_m, terrain_);
  return judge_.refresh(dirty, T_world_body_, tiles_, grid_);
}

std::vector<CellIndex> WorldMap::refresh_terrain() {
  terrain_.version = grid_.version;
  std::vector<CellIndex> changed =
      terrain_builder_.refresh(tiles_, cells_per_height_, max_step_m(), terrain_);
  tiles_.rest_outside(T_world_body_.translation().head<2>(), max_range_m_ + kRestTiles * tile_side_m(),
                      grid_.lattice().pitch_m);
  return changed;
}

HeightError WorldMap::begin_level(const HeightError& error) {
  settled_frames_ = 1;
  level_frames_ = error.lift_m != 0 ? alignment_.level_start_frames : 0;
  return error.share(level_frames_ / (1 + level_frames_));
}

HeightError WorldMap::split_error(const HeightError& error) {
  if (settled_frames_ == kFramesToSettle) return error.share(kShareOfFrame);
  const double share_of_map = 1.0 / (level_frames_ + ++settled_frames_);
  if (error.lift_m != 0) memory_.lift(error.share(share_of_map), {pitch_m_}, tiles_);
  return error.share(1 - share_of_map);
}

void WorldMap::wake_around(const Pose& T_world_body) {
  const std::vector<MapTile*> woken =
      tiles_.wake_within(T_world_body.translation().head<2>(), max_range_m_ + kWakeTiles * tile_side_m(),
                         grid_.lattice().pitch_m);
  for (MapTile* tile : woken) memory_.take_woken(*tile);
}

MapMemory WorldMap::memory() const {
  return {.pitch_m = pitch_m_,
          .cells_per_vertex = tiles_.cells_per_vertex(),
          .utime_us = utime_us_,
          .T_world_body = T_world_body_,
          .T_global_local = std::nullopt,
          .tiles = tiles_.packed()};
}

void WorldMap::restore(const MapMemory& memory) {
  MapTiles restored;
  restored.set_cells_per_vertex(memory.cells_per_vertex);
  for (const auto& [index, bytes] : memory.tiles) restored.add_resting(index, bytes);
  if (memory.pitch_m > 0) {
    take_lattice(memory.pitch_m);
    if (tiles_.cells_per_vertex() != memory.cells_per_vertex)
      throw std::invalid_argument("map of resolution " +
                                  std::to_string(memory.pitch_m * memory.cells_per_vertex) + ", not " +
                                  std::to_string(grid_.lattice().pitch_m));
  }
  start_epoch();
  tiles_ = std::move(restored);
  settled_frames_ = kFramesToSettle;
  utime_us_ = memory.utime_us;
  T_world_body_ = memory.T_world_body;
  for (MapTile* tile : tiles_.wake_all()) memory_.take_woken(*tile);
  refresh();
  refresh_terrain();
}

std::int64_t WorldMap::memory_bytes() const {
  const auto of_map = [](const auto& map) {
    using Entry = std::decay_t<decltype(*map.tiles().begin())>;
    using Tile = typename std::decay_t<decltype(map.tiles())>::mapped_type::element_type;
    return static_cast<std::int64_t>(map.tiles().size() * (sizeof(Tile) + sizeof(Entry) + sizeof(void*)));
  };
  std::int64_t clearances = 0;
  for (const auto& [index, tile] : grid_.tiles())
    clearances += static_cast<std::int64_t>(tile->clearance.memory_bytes());
  return tiles_.memory_bytes() + of_map(grid_) + clearances + of_map(terrain_) +
         judge_.floor().memory_bytes();
}

void WorldMap::start_epoch() {
  memory_.clear();
  judge_.clear();
  tiles_.clear();
  grid_.clear();
  terrain_.clear();
  terrain_builder_.clear();
  settled_frames_ = 0;
  ++grid_.epoch;
  ++grid_.version;
  terrain_.epoch = grid_.epoch;
}

}  // namespace floornav
