#include "tools/bench/map_cost.hpp"

#include <cmath>

#include "mapping/world_map.hpp"
#include "perception/floor_perception.hpp"
#include "tools/bench/bench_scene.hpp"
#include "tools/bench/cpu_clock.hpp"
#include "tools/simulator/depth_sensor.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kMovePerFrame_m = 0.03;
constexpr std::int64_t kFrame_us = 33'333;
constexpr double kMedian = 0.5;
constexpr double kAlmostAll = 0.99;

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
  [[nodiscard]] double area_m2() const { return patches_ * patch_m2_; }
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
  const Shapes shapes = bench_scene();
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
  cost.fuse_median_ms = quantile_of(fuse_ms, kMedian);
  cost.fuse_p99_ms = quantile_of(fuse_ms, kAlmostAll);
  cost.refresh_median_ms = quantile_of(refresh_ms, kMedian);
  cost.refresh_p99_ms = quantile_of(refresh_ms, kAlmostAll);
  return cost;
}

std::vector<MapSizeCost> measure_map_sizes(const std::vector<FloorEvidence>& frames,
                                           const std::vector<double>& areas_m2) {
  constexpr int kLaps = 2;
  constexpr std::int32_t kLegs = 20;
  constexpr std::int32_t kLeg_cells = 32;
  constexpr std::int64_t kUpdatesPerTerrain = 30;  // once a second
  std::int64_t updates = 0;
  WorldMap map(MappingSettings{}, RobotSettings{});
  SiteSurvey survey(frames.front().lattice);
  std::int64_t utime_us = 0;
  std::vector<MapSizeCost> costs;
  for (const double area_m2 : areas_m2) {
    survey.extend_to(area_m2, map);
    std::vector<double> update_ms;
    double sum_ms = 0;
    for (int lap = 0; lap <= kLaps; ++lap) {
      for (std::int32_t leg = 0; leg < 2 * kLegs; ++leg) {
        const std::int32_t along = leg < kLegs ? leg : 2 * kLegs - 1 - leg;
        for (const FloorEvidence& frame : frames) {
          utime_us = std::max(utime_us, survey.utime_us()) + kFrame_us;
          const FloorEvidence seen = moved(frame, {along * kLeg_cells, 0}, utime_us);
          const double began_ms = thread_cpu_ms();
          map.integrate(seen);
          map.refresh();
          if (++updates % kUpdatesPerTerrain == 0) map.refresh_terrain();
          if (lap == 0) continue;  // the lane itself is seen for the first time
          update_ms.push_back(thread_cpu_ms() - began_ms);
          sum_ms += update_ms.back();
        }
      }
    }
    const double bytes = static_cast<double>(map.memory_bytes());
    costs.push_back({survey.area_m2(), quantile_of(update_ms, kMedian),
                     sum_ms / static_cast<double>(update_ms.size()), bytes / survey.area_m2()});
  }
  return costs;
}

}  // namespace floornav
