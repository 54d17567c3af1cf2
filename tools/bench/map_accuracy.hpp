#pragma once

#include <cstdint>
#include <span>

#include "mapping/grid_map.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/pose.hpp"
#include "tools/simulator/drivable.hpp"
#include "tools/simulator/odometry.hpp"
#include "tools/simulator/sensor_spec.hpp"

namespace floornav {

/// The map against the truth, over cells that stand in the sensor's view within 3 m.
struct MapAccuracy {
  std::int64_t drivable = 0;          ///< seen
  std::int64_t drivable_blocked = 0;  ///< of them
  std::int64_t drivable_inside = 0;   ///< seen, and all eight cells around are drivable too
  std::int64_t drivable_inside_blocked = 0;
  std::int64_t beside_step = 0;  ///< seen: TruthCell::beside_step; neither drivable nor undrivable here
  std::int64_t beside_step_free = 0;
  std::int64_t undrivable = 0;         ///< seen
  std::int64_t undrivable_free = 0;    ///< of them
  std::int64_t undrivable_inside = 0;  ///< seen, and none of the eight cells around is drivable
  std::int64_t undrivable_inside_free = 0;
  std::int64_t in_view = 0;   ///< all cells of the sector that is looked at
  std::int64_t unseen = 0;    ///< of them
  std::int64_t heights = 0;   ///< free cells that are drivable
  double square_m2 = 0;       ///< sum of their squared height errors
  double pose_square_m2 = 0;  ///< the same of a map that errs as the mean of the told poses does, and no more
  double shape_square_m2 = 0;  ///< of the heights after each world's mean error plane is taken out

  void add(const MapAccuracy& more);
};

struct MapAccuracyOptions {
  int worlds = 50;
  int frames = 10;          ///< of a robot that drives at 2 cm a frame
  double difficulty = 0.7;  ///< of the random worlds
  PoseNoise pose_noise{.position_m = 0.01, .angle_deg = 0.3};
  std::uint64_t seed = 1;
};

/// Adds what a map says of the floor in front of a robot. `T_world_body`: where it truly is. `T_told_true`:
/// of each frame, the pose that was told after the inverse of the true one.
void judge_map(const GridMap& map, const TruthGrid& truth, const Pose& T_world_body, const SensorSpec& sensor,
               std::span<const Pose> T_told_true, MapAccuracy& accuracy);

/// Random worlds seen by a Kinect through perception and mapper, the pose told with noise.
MapAccuracy measure_map_accuracy(const MapAccuracyOptions& options, Parallel& parallel);

}  // namespace floornav
