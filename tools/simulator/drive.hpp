#pragma once

#include <cstdint>

#include "runtime/geometry/robot.hpp"
#include "runtime/process/log_writer.hpp"
#include "tools/simulator/odometry.hpp"
#include "tools/simulator/scene.hpp"
#include "tools/simulator/sensor_spec.hpp"
#include "tools/simulator/trajectory.hpp"

namespace floornav {

/// The instant at which every simulated drive begins: the same drive makes the same bytes.
inline constexpr std::int64_t kDriveStart_us = 1'370'000'000'000'000;

struct DriveSettings {
  SensorSpec sensor;
  PoseNoise pose_noise;
  double pose_rate_hz = 50.0;
  double cloud_latency_s = 0.0;  ///< from exposure to arrival in the log
  double pose_latency_s = 0.0;
  double seconds = 0.0;  ///< 0: to the end of the plan
  std::uint64_t seed = 1;
};

struct DriveSummary {
  int frames = 0;
  int poses = 0;
  double seconds = 0;
  double length_m = 0;
  PlanarState start;
  PlanarState end;
};

/// Drives the robot along the scene's plan and writes what its sensor and its odometry say. The scene must
/// have a drive; throws std::invalid_argument otherwise.
DriveSummary record_drive(const Scene& scene, const RobotSettings& robot, const DriveSettings& settings,
                          LogWriter& log);

}  // namespace floornav
