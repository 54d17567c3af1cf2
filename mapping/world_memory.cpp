#include "mapping/world_memory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/robot_limits.hpp"

namespace floornav {
namespace {

float square(double value) {
  return static_cast<float>(value * value);
}

}  // namespace

WorldMemory::WorldMemory(const MappingSettings& settings, const RobotSettings& robot)
    : settings_(settings),
      reader_(square(settings.view_sigma_m), static_cast<float>(step_limit_m(robot))),
      coverage_(static_cast<float>(step_limit_m(robot) / 4)),
      limits_{.gate_m = static_cast<float>(step_limit_m(robot) / 2),
              .ray_margin_m = static_cast<float>(step_limit_m(robot)),
              .memory_var_m2 = square(settings.memory_sigma_m)},
      drop_m_(static_cast<float>(step_limit_m(robot))),
      overhead_m_(static_cast<float>(robot.height_m + settings.overhead_margin_m)) {}

void WorldMemory::sort_by_cell(const FloorEvidence& evidence, Taken& taken) {
  const Eigen::Vector3d body = evidence.T_world_body.translation();
  const auto in_range = [&](CellIndex cell) {
    const double x_m = evidence.lattice.center_of(cell.ix) - body.x();
    const double y_m = evidence.lattice.center_of(cell.iy) - body.y();
    return x_m * x_m + y_m * y_m <= settings_.max_range_m * settings_.max_range_m;
  };
  order_.clear();
  for (std::uint32_t i = 0; i < evidence.cells.size(); ++i) {
    const CellEvidence& cell = evidence.cells[i];
    if (EvidenceReader::is_valid(cell, evidence) && in_range(cell.cell)) order_.push_back(i);
  }
  taken.refused = static_cast<std::int64_t>(evidence.cells.size() - order_.size());
  taken.cells = static_cast<std::int64_t>(order_.size());
  const auto key = [&](std::uint32_t i) { return evidence.cells[i].cell; };
  if (!std::ranges::is_sorted(order_, {}, key)) std::ranges::stable_sort(order_, {}, key);
}

CellView WorldMemory::view_of(const FloorEvidence& evidence, Entries entries) {
  sightings_.clear();
  CellView view;
  for (const std::uint32_t i : entries) {
    const CellEvidence& cell = evidence.cells[i];
    view.ray_z_m = std::fmin(view.ray_z_m, cell.ray_z_m);
    view.no_return = view.no_return || cell.no_return;
    view.partly_hidden = view.partly_hidden || cell.partly_hidden;
    view.on_edge = view.on_edge || cell.on_edge;
    reader_.read(cell, evidence, coverage_.of(evidence, i), sightings_);
  }
  if (sightings_.size() > 1) std::ranges::stable_sort(sightings_, {}, &Sighting::z_m);
  return view;
}

float WorldMemory::floor_z_m(const FloorEvidence& evidence, CellIndex cell, CellIndex vertex,
                             const FloorHeight& floor) {
  const CellIndex block = floor.block_at(vertex);
  if (!last_block_.known || last_block_.block != block)
    last_block_ = {block, floor.block_height(block), true};
  if (last_block_.height_m) return *last_block_.height_m;
  const Lattice& lattice = evidence.lattice;
  return plane_height_m(evidence.T_world_body, lattice.center_of(cell.ix), lattice.center_of(cell.iy));
}

bool WorldMemory::split_overhead(CellMemory& memory, float limit_z_m) {
  const auto erased = std::erase_if(sightings_, [&](const Sighting& sighting) {
    const bool above = sighting.lowest_z_m > limit_z_m;
    if (above) memory.see_overhead(sighting.lowest_z_m);
    return above;
  });
  return erased > 0;
}

void WorldMemory::take_cell(const FloorEvidence& evidence, Entries entries, const FloorHeight& floor,
                            MapTiles& tiles) {
  const CellIndex cell = evidence.cells[entries.front()].cell;
  const CellIndex vertex = tiles.vertex_of(cell);
  CellView view = view_of(evidence, entries);
  const float floor_m = floor_z_m(evidence, cell, vertex, floor);
  view.no_return = view.no_return || view.ray_z_m < floor_m - drop_m_;
  const bool only_clears = sightings_.empty() && !view.no_return;
  const CellIndex place = GridMap::tile_of(vertex);
  MapTile* const tile =
      only_clears ? tiles.find(place) : &tiles.make(place, evidence.T_world_body.translation().z());
  if (tile == nullptr) return;
  const std::size_t slot = tiles.slot_of(cell);
  CellMemory memory = tile->cells.at(slot);
  const float overhead_before_m = memory.overhead_z_m();
  const bool overhead = split_overhead(memory, floor_m + overhead_m_);
  tile->overhead_moved = tile->overhead_moved || (overhead && memory.overhead_z_m() != overhead_before_m);
  view.sightings = sightings_;
  if (!memory.fuse(view, limits_) && !overhead) return;
  tile->cells.set(slot, memory);
  const std::size_t index = GridMap::index_of(vertex);
  touch(*tile, index);
  tile->high_tops = tile->high_tops || memory.has_high_top();
  if (!sightings_.empty()) tile->seen().set(index, GridTile::Seen::at(evidence.utime_us));
}

void WorldMemory::touch(MapTile& tile, std::size_t vertex) {
  if (tile.touched.none()) touched_.push_back(tile.index);
  tile.touched.set(vertex);
}

void WorldMemory::lift(const HeightError& by, const Lattice& lattice, MapTiles& tiles) {
  const Eigen::Vector2f rise = by.rise.cast<float>();
  for (const CellIndex index : tiles.awake()) {
    MapTile& tile = *tiles.find(index);
    const std::size_t per_vertex = tile.cells.size() / tile.vertices.size();
    for (std::size_t slot = 0; slot < tile.cells.size(); ++slot) {
      CellMemory memory = tile.cells.at(slot);
      if (!memory.lower().exists() && std::isnan(memory.overhead_z_m())) continue;
      const CellIndex cell = tiles.cell_at(tile, slot);
      const auto by_m = static_cast<float>(by.at(lattice.center_of(cell.ix), lattice.center_of(cell.iy)));
      memory.lift(by_m, rise.x(), rise.y());
      tile.cells.set(slot, memory);
      tile.overhead_moved = true;
      touch(tile, slot / per_vertex);
    }
  }
}

void WorldMemory::take_woken(MapTile& tile) {
  touched_.push_back(tile.index);
  for (std::size_t slot = 0; slot < tile.cells.size(); ++slot)
    tile.high_tops = tile.high_tops || (tile.cells.has_more(slot) && tile.cells.at(slot).has_high_top());
}

/// Whether this frame saw a surface about this high in a cell.
bool WorldMemory::saw(const FloorEvidence& evidence, CellIndex cell, float z_m) const {
  constexpr float kAbout_m = 0.1F;
  const auto key = [&](std::uint32_t i) { return evidence.cells[i].cell; };
  const auto entries = std::ranges::equal_range(order_, cell, {}, key);
  return std::ranges::any_of(entries, [&](std::uint32_t i) {
    const CellEvidence& seen = evidence.cells[i];
    return seen.points >= Level::kTrusted && std::abs(seen.mean_z_m - z_m) < kAbout_m;
  });
}

void WorldMemory::see_through_tops(const FloorEvidence& evidence, const Eigen::Vector3d& sensor_m,
                                   MapTile& tile, const MapTiles& tiles) {
  constexpr double kLeastAbove_m = 0.05;
  const Lattice& lattice = evidence.lattice;
  for (std::size_t slot = 0; slot < tile.cells.size(); ++slot) {
    if (!tile.cells.has_more(slot)) continue;
    CellMemory memory = tile.cells.at(slot);
    if (!memory.has_high_top()) continue;
    const double above_top_m = sensor_m.z() - static_cast<double>(memory.upper().z_m);
    if (above_top_m < kLeastAbove_m) continue;
    const CellIndex cell = tiles.cell_at(tile, slot);
    const Eigen::Vector2d top_m(lattice.center_of(cell.ix), lattice.center_of(cell.iy));
    const double farther = (sensor_m.z() - static_cast<double>(memory.lower().z_m)) / above_top_m;
    const Eigen::Vector2d floor_m = sensor_m.head<2>() + farther * (top_m - sensor_m.head<2>());
    if (!saw(evidence, lattice.cell_of(floor_m.x(), floor_m.y()), memory.lower().z_m)) continue;
    if (saw(evidence, cell, memory.upper().z_m)) continue;
    memory.see_through_top();
    tile.cells.set(slot, memory);
    touch(tile, slot / (tile.cells.size() / tile.vertices.size()));
  }
}

/// Floor that is seen below a table came into sight from the side and says nothing of its top. But where the
/// sight line to a piece of floor crosses the height of a remembered top inside that top, the top is gone.
void WorldMemory::see_through_tops(const FloorEvidence& evidence, MapTiles& tiles) {
  const Eigen::Vector3d sensor_m = (evidence.T_world_body * evidence.T_body_sensor).translation();
  const auto corner = [&](double offset_m) {
    const Eigen::Vector2d at_m = sensor_m.head<2>().array() + offset_m;
    return GridMap::tile_of(tiles.vertex_of(evidence.lattice.cell_of(at_m.x(), at_m.y())));
  };
  const CellIndex first = corner(-settings_.max_range_m);
  const CellIndex last = corner(settings_.max_range_m);
  for (std::int32_t iy = first.iy; iy <= last.iy; ++iy)
    for (std::int32_t ix = first.ix; ix <= last.ix; ++ix)
      if (MapTile* const tile = tiles.find({ix, iy}); tile != nullptr && tile->high_tops)
        see_through_tops(evidence, sensor_m, *tile, tiles);
}

WorldMemory::Taken WorldMemory::take(const FloorEvidence& evidence, const FloorHeight& floor,
                                     MapTiles& tiles) {
  Taken taken;
  sort_by_cell(evidence, taken);
  coverage_.take(evidence, order_);
  last_block_.known = false;
  for (std::size_t first = 0; first < order_.size();) {
    std::size_t last = first + 1;
    while (last < order_.size() && evidence.cells[order_[last]].cell == evidence.cells[order_[first]].cell)
      ++last;
    take_cell(evidence, Entries(order_).subspan(first, last - first), floor, tiles);
    first = last;
  }
  see_through_tops(evidence, tiles);
  return taken;
}

std::vector<CellIndex> WorldMemory::take_touched() {
  std::ranges::sort(touched_);
  return std::exchange(touched_, {});
}

}  // namespace floornav
