#include "tools/bench/map_accuracy.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "tools/bench/frame_stack.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/random_world.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

constexpr double kRange_m = 3.0;
constexpr double kMovePerFrame_m = 0.02;

struct HeightSample {
  Eigen::Vector2d place_m;
  double error_m;
};

/// Sum of squares after the plane that fits the errors best is taken out.
double shape_square(const std::vector<HeightSample>& samples) {
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const HeightSample& s : samples) {
    const Eigen::Vector3d row(1, s.place_m.x(), s.place_m.y());
    normal += row * row.transpose();
    right += s.error_m * row;
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  double sum = 0;
  for (const HeightSample& s : samples) {
    const double rest = s.error_m - plane.dot(Eigen::Vector3d(1, s.place_m.x(), s.place_m.y()));
    sum += rest * rest;
  }
  return sum;
}

/// How high the mean of the told poses puts a piece of floor above its place.
double pose_error_m(std::span<const Pose> T_told_true, const Eigen::Vector3d& floor_m) {
  double sum_m = 0;
  for (const Pose& error : T_told_true) sum_m += (error * floor_m - floor_m).z();
  return T_told_true.empty() ? 0.0 : sum_m / static_cast<double>(T_told_true.size());
}

bool in_view(const Eigen::Vector2d& place_m, const Pose& T_world_body, const SensorSpec& sensor) {
  const Eigen::Vector3d eye = (T_world_body * sensor.T_body_sensor).translation();
  const Eigen::Vector2d away = place_m - eye.head<2>();
  const Eigen::Vector2d ahead = T_world_body.linear().col(0).head<2>().normalized();
  const double half_width = 0.5 * sensor.camera.width / static_cast<double>(sensor.camera.fx);
  const double forward = ahead.dot(away);
  const double sideways = std::abs(ahead.x() * away.y() - ahead.y() * away.x());
  return away.norm() <= kRange_m && forward > 0 && sideways <= half_width * forward;
}

/// How many of the eight cells around are drivable.
int drivable_around(const TruthGrid& truth, const Eigen::Vector2d& place_m) {
  int sum = 0;
  for (std::size_t k = 0; k < kNeighbourX.size(); ++k) {
    const Eigen::Vector2d step(kNeighbourX[k], kNeighbourY[k]);
    const TruthCell* cell = truth.at(place_m + truth.lattice.pitch_m * step);
    sum += cell != nullptr && cell->drivable ? 1 : 0;
  }
  return sum;
}

void count_state(const TruthCell& cell, int around, VertexState state, MapAccuracy& accuracy) {
  const bool blocked = state == VertexState::kBlocked;
  if (cell.beside_step) {
    ++accuracy.beside_step;
    accuracy.beside_step_free += blocked ? 0 : 1;
    return;
  }
  if (cell.drivable) {
    ++accuracy.drivable;
    accuracy.drivable_blocked += blocked ? 1 : 0;
    if (around < 8) return;
    ++accuracy.drivable_inside;
    accuracy.drivable_inside_blocked += blocked ? 1 : 0;
  } else {
    ++accuracy.undrivable;
    accuracy.undrivable_free += blocked ? 0 : 1;
    if (around > 0) return;
    ++accuracy.undrivable_inside;
    accuracy.undrivable_inside_free += blocked ? 0 : 1;
  }
}

MapAccuracy see_world(const MapAccuracyOptions& options, std::uint64_t key) {
  const RobotSettings robot;
  const RandomWorld world = random_world(key, options.difficulty, 0, robot);
  DepthSensor sensor(kinect(), key);
  Odometry odometry(options.pose_noise, random_key({key, 0x0D0}));
  FrameStack stack(PerceptionSettings{}, MappingSettings{}, robot);
  Pose T_world_body = Pose::Identity();
  std::vector<Pose> T_told_true;
  for (int frame = 0; frame < options.frames; ++frame) {
    const PlanarState state{{(frame + 1 - options.frames) * kMovePerFrame_m, 0}, {1, 0}};
    T_world_body = body_on_floor(world.scene.fixed, state);
    const Pose told = odometry.measure(T_world_body);
    T_told_true.push_back(told * T_world_body.inverse());
    stack.see(sensor, sensor.measure(world.scene.fixed, T_world_body, frame), told);
  }
  MapAccuracy accuracy;
  judge_map(stack.published(), world.truth, T_world_body, sensor.model(), T_told_true, accuracy);
  return accuracy;
}

}  // namespace

void MapAccuracy::add(const MapAccuracy& more) {
  drivable += more.drivable;
  drivable_blocked += more.drivable_blocked;
  drivable_inside += more.drivable_inside;
  drivable_inside_blocked += more.drivable_inside_blocked;
  beside_step += more.beside_step;
  beside_step_free += more.beside_step_free;
  undrivable += more.undrivable;
  undrivable_free += more.undrivable_free;
  undrivable_inside += more.undrivable_inside;
  undrivable_inside_free += more.undrivable_inside_free;
  in_view += more.in_view;
  unseen += more.unseen;
  heights += more.heights;
  square_m2 += more.square_m2;
  pose_square_m2 += more.pose_square_m2;
  shape_square_m2 += more.shape_square_m2;
}

void judge_map(const GridMap& map, const TruthGrid& truth, const Pose& T_world_body, const SensorSpec& sensor,
               std::span<const Pose> T_told_true, MapAccuracy& accuracy) {
  const Lattice& lattice = map.lattice();
  const Eigen::Vector2d body_m = T_world_body.translation().head<2>();
  const CellIndex first = lattice.cell_of(body_m.x() - kRange_m, body_m.y() - kRange_m);
  const CellIndex last = lattice.cell_of(body_m.x() + kRange_m, body_m.y() + kRange_m);
  std::vector<HeightSample> samples;
  for (std::int32_t iy = first.iy; iy <= last.iy; ++iy) {
    for (std::int32_t ix = first.ix; ix <= last.ix; ++ix) {
      const Eigen::Vector2d place_m(lattice.center_of(ix), lattice.center_of(iy));
      const TruthCell* const cell = truth.at(place_m);
      if (cell == nullptr || !in_view(place_m, T_world_body, sensor)) continue;
      ++accuracy.in_view;
      const VertexState state = map.state({ix, iy});
      if (state == VertexState::kUnknown) {
        ++accuracy.unseen;
        continue;
      }
      count_state(*cell, drivable_around(truth, place_m), state, accuracy);
      if (!cell->drivable || state != VertexState::kFree) continue;
      const GridTile& tile = *map.find(GridMap::tile_of({ix, iy}));
      const double z_m = static_cast<double>(tile.height_m(GridTile::index_of({ix, iy})));
      const auto true_m = static_cast<double>(cell->height_m);
      samples.push_back({place_m, z_m - true_m});
      accuracy.pose_square_m2 += std::pow(pose_error_m(T_told_true, {place_m.x(), place_m.y(), true_m}), 2);
    }
  }
  accuracy.heights += static_cast<std::int64_t>(samples.size());
  for (const HeightSample& s : samples) accuracy.square_m2 += s.error_m * s.error_m;
  accuracy.shape_square_m2 += shape_square(samples);
}

MapAccuracy measure_map_accuracy(const MapAccuracyOptions& options, Parallel& parallel) {
  std::vector<MapAccuracy> of_world(static_cast<std::size_t>(options.worlds));
  parallel.run(options.worlds, [&](int world, int) {
    const auto i = static_cast<std::size_t>(world);
    of_world[i] = see_world(options, random_key({options.seed, i, 0x3A9}));
  });
  MapAccuracy sum;
  for (const MapAccuracy& accuracy : of_world) sum.add(accuracy);
  return sum;
}

}  // namespace floornav
