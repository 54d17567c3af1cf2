#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/node/grid_map_message.hpp"
#include "runtime/geometry/robot.hpp"
#include "runtime/process/log_writer.hpp"
#include "tools/simulator/odometry.hpp"
#include "tools/simulator/random_world.hpp"
#include "tools/simulator/sensor_spec.hpp"
#include "tools/simulator/trajectory.hpp"

namespace floornav {

struct ClosedLoopSettings {
  SensorSpec sensor;       ///< its rate is the closed loop's
  bool known_map = false;  ///< the planner is told the true map; there is no sensor, perception or mapper
  PoseNoise pose_noise;
  double cloud_latency_s = 0.05;
  double pose_latency_s = 0.01;
  double command_latency_s = 0.02;  ///< from PATH to the wheels
  double jitter_s = 0.02;           ///< at most, added to every latency
  double patience_s = 20.0;         ///< without moving, then the robot has stopped for good
  double most_s = 0.0;  ///< virtual time of a run; 0: a minute and 8 s a metre of the shortest way
};

enum class Outcome { kReached, kStopped, kCollided };

struct ClosedLoopResult {
  Outcome outcome = Outcome::kStopped;
  std::string reason;  ///< of the last PATH, or what was hit
  double seconds = 0;  ///< virtual
  double travelled_m = 0;
  double shortest_m = 0;  ///< on the true map, for the robot's circle, to where the run reached the goal;
                          ///< else to within its tolerance
  int replans = 0;        ///< paths that led elsewhere than the one before
  Eigen::Vector2d end_m{0, 0};
};

/// What is kept of a run on request.
struct RunRecord {
  LogWriter* log = nullptr;  ///< gets every message
  GridMapReceiver map;       ///< as last published
  std::vector<Eigen::Vector2d> driven_m;
  std::vector<Eigen::Vector2d> path_m;  ///< the last one
  PlanarState end;
};

/// Drives a robot through a world with perception, mapper and planner in one process and in virtual time. The
/// same arguments give the same run. People who walk there wait while the robot is in their way.
ClosedLoopResult drive_world(const RandomWorld& world, const RobotSettings& robot,
                             const ClosedLoopSettings& settings, std::uint64_t seed, RunRecord* record);

}  // namespace floornav
