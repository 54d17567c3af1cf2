#include "tools/bench/map_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mapping/node/terrain_map_message.hpp"
#include "mapping/world_map.hpp"
#include "perception/floor_perception.hpp"
#include "tools/bench/cpu_clock.hpp"
#include "tools/simulator/depth_sensor.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kMovePerFrame_m = 0.1;
constexpr std::int64_t kFrame_us = 33'333;
constexpr double kMedian = 0.5;
constexpr double kAlmostAll = 0.99;

/// A street with boxes on both sides.
Shapes street() {
  constexpr int kBoxes = 14;
  Shapes shapes;
  for (int i = 0; i < kBoxes; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const Footprint footprint{
        {1.2 + 1.1 * i, side * (0.7 + 0.1 * (i % 3))}, {1, 0}, {0.15, 0.1 + 0.03 * (i % 4)}};
    shapes.blocks.push_back({footprint, -1.0, 0.06 + 0.07 * (i % 5), {0, 0}});
  }
  return shapes;
}

/// What was seen of a map.
double area_m2(const GridMap& map) {
  std::int64_t seen = 0;
  for (const auto& [index, tile] : map.tiles())
    seen += GridTile::kVertices - static_cast<std::int64_t>(tile->state.count(VertexState::kUnknown));
  return static_cast<double>(seen) * map.lattice().pitch_m * map.lattice().pitch_m;
}

/// Bytes of the messages that tell all of a terrain map, for each square metre of it that was seen.
double terrain_bytes_per_m2(const std::vector<FloorEvidence>& frames, double resolution_m) {
  MappingSettings settings;
  settings.terrain_resolution_m = resolution_m;
  WorldMap map(settings, RobotSettings{});
  for (const FloorEvidence& frame : frames) map.integrate(frame);
  map.refresh();
  map.refresh_terrain();
  std::int64_t seen = 0;
  for (const auto& [index, tile] : map.terrain().tiles())
    seen += TerrainTile::kCells - std::ranges::count(tile->height, TerrainTile::kUnknown);
  std::int64_t bytes = 0;
  for (const terrain_map_t& message :
       to_messages(map.terrain(), map.terrain().sorted_tiles(), map.utime_us()))
    bytes += message.getEncodedSize();
  return static_cast<double>(bytes) / (static_cast<double>(seen) * resolution_m * resolution_m);
}

/// The frame as it would be seen elsewhere, whole cells away.
FloorEvidence moved(const FloorEvidence& frame, CellIndex by, std::int64_t utime_us) {
  FloorEvidence result = frame;
  const Eigen::Vector3d by_m(by.ix * frame.lattice.pitch_m, by.iy * frame.lattice.pitch_m, 0);
  result.utime_us = utime_us;
  result.T_world_body.pretranslate(by_m);
  for (Surfel& surfel : result.surfels) surfel.centroid_m += by_m;
  for (CellEvidence& cell : result.cells) {
    cell.cell.ix += by.ix;
    cell.cell.iy += by.iy;
  }
  return result;
}

constexpr std::int32_t kPatch_cells = 160;

/// A square of level floor, seen at once by a robot in its middle.
FloorEvidence level_floor(const Lattice& lattice) {
  FloorEvidence frame;
  frame.lattice = lattice;
  const double middle_m = 0.5 * kPatch_cells * lattice.pitch_m;
  frame.T_world_body.translation() = Eigen::Vector3d(middle_m, middle_m, 0);
  frame.T_body_sensor.translation().z() = 1;
  Surfel surfel;
  surfel.centroid_m = frame.T_world_body.translation();
  surfel.normal = Eigen::Vector3f::UnitZ();
  surfel.points = kPatch_cells * kPatch_cells;
  frame.surfels.push_back(surfel);
  for (std::int32_t ix = 0; ix < kPatch_cells; ++ix) {
    for (std::int32_t iy = 0; iy < kPatch_cells; ++iy) {
      CellEvidence cell;
      cell.cell = {ix, iy};
      cell.surfel = 0;
      cell.points = 10;
      cell.mean_z_m = 0;
      cell.top_z_m = 0;
      cell.var_z_m2 = 4e-6F;
      frame.cells.push_back(cell);
    }
  }
  return frame;
}

/// Drives over level floor that nobody has seen yet, in rows like a street plan, away from the origin.
class SiteSurvey {
 public:
  explicit SiteSurvey(const Lattice& lattice)
      : patch_(level_floor(lattice)), patch_m2_(std::pow(kPatch_cells * lattice.pitch_m, 2)) {}

  void extend_to(double area_m2, WorldMap& map) {
    for (; patches_ * patch_m2_ < area_m2; ++patches_) {
      const std::int32_t row = patches_ / kPatchesPerRow;
      const std::int32_t column = patches_ % kPatchesPerRow;
      const CellIndex by{(column - 1) * kPatch_cells, -(row + 1) * kPatch_cells};
      map.integrate(moved(patch_, by, ++utime_us_));
      map.refresh();
      map.refresh_terrain();
    }
  }
  [[nodiscard]] std::int64_t utime_us() const { return utime_us_; }

 private:
  static constexpr std::int32_t kPatchesPerRow = 40;
  FloorEvidence patch_;
  double patch_m2_;
  std::int32_t patches_ = 0;
  std::int64_t utime_us_ = 0;
};

}  // namespace

std::vector<FloorEvidence> kinect_evidence(int frames) {
  const Shapes shapes = street();
  DepthSensor sensor(kinect(), kSeed);
  const SensorSpec& spec = sensor.model();
  FloorPerception perception(PerceptionSettings{}, RobotSettings{});
  Serial serial;
  std::vector<FloorEvidence> evidence;
  for (int i = 0; i < frames; ++i) {
    const Pose T_world_body = body_on_floor(shapes, {{i * kMovePerFrame_m, 0}, {1, 0}});
    DepthFrame frame;
    frame.utime_us = (i + 1) * kFrame_us;
    frame.camera = spec.camera;
    frame.scale = static_cast<float>(sensor.unit());
    frame.baseline_m = static_cast<float>(spec.baseline_m);
    frame.disparity_sigma_px = static_cast<float>(spec.noise.sigma_px / spec.decimation);
    frame.T_body_sensor = spec.T_body_sensor;
    frame.pixels = sensor.measure(shapes, T_world_body, i);
    evidence.push_back(perception.process(frame, T_world_body, serial, [](std::int64_t) { return true; }));
  }
  return evidence;
}

FuseCost measure_fuse(const std::vector<FloorEvidence>& frames, int repeats) {
  WorldMap map(MappingSettings{}, RobotSettings{});
  std::vector<double> fuse_ms, refresh_ms;
  FuseCost cost;
  for (const FloorEvidence& frame : frames) cost.cells += static_cast<double>(frame.cells.size());
  cost.cells /= static_cast<double>(frames.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (const FloorEvidence& frame : frames) {
      const double began_ms = thread_cpu_ms();
      map.integrate(frame);
      const double fused_ms = thread_cpu_ms();
      map.refresh();
      const double done_ms = thread_cpu_ms();
      fuse_ms.push_back(fused_ms - began_ms);
      refresh_ms.push_back(done_ms - fused_ms);
    }
  }
  cost.terrain_bytes_per_m2 = terrain_bytes_per_m2(frames, 0.2);
  cost.fine_terrain_bytes_per_m2 = terrain_bytes_per_m2(frames, 0.1);
  cost.fuse_median_ms = quantile_of(fuse_ms, kMedian);
  cost.fuse_p99_ms = quantile_of(fuse_ms, kAlmostAll);
  cost.refresh_median_ms = quantile_of(refresh_ms, kMedian);
  cost.refresh_p99_ms = quantile_of(refresh_ms, kAlmostAll);
  return cost;
}

std::vector<MapSizeCost> measure_map_sizes(const std::vector<FloorEvidence>& frames,
                                           const std::vector<double>& areas_m2) {
  constexpr int kLaps = 6;  // the first is not counted: it sees the street for the first time
  constexpr std::int64_t kUpdatesPerTerrain = 30;
  WorldMap map(MappingSettings{}, RobotSettings{});
  SiteSurvey survey(frames.front().lattice);
  std::int64_t updates = 0;
  std::vector<MapSizeCost> costs;
  for (const double area : areas_m2) {
    survey.extend_to(area, map);
    std::vector<double> update_ms;
    for (std::size_t i = 0; i < kLaps * frames.size(); ++i) {
      const std::size_t place = i % (2 * frames.size());
      const FloorEvidence& frame = frames[place < frames.size() ? place : 2 * frames.size() - 1 - place];
      const FloorEvidence seen = moved(frame, {0, 0}, survey.utime_us() + ++updates * kFrame_us);
      const double began_ms = thread_cpu_ms();
      map.integrate(seen);
      map.refresh();
      if (updates % kUpdatesPerTerrain == 0) map.refresh_terrain();
      if (i >= frames.size()) update_ms.push_back(thread_cpu_ms() - began_ms);
    }
    const double sum_ms = std::accumulate(update_ms.begin(), update_ms.end(), 0.0);
    const double m2 = area_m2(map.grid());
    costs.push_back({m2, quantile_of(update_ms, kMedian), sum_ms / static_cast<double>(update_ms.size()),
                     static_cast<double>(map.memory_bytes()) / m2});
  }
  return costs;
}

}  // namespace floornav
