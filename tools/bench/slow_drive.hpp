#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "mapping/settings.hpp"
#include "tools/bench/frame_stack.hpp"
#include "tools/simulator/depth_sensor.hpp"
#include "tools/simulator/shapes.hpp"

namespace floornav {

/// A sensor on a robot that drives at 0.2 m/s, ten frames a second, and two maps: of all frames of the drive,
/// and of its last one alone.
class DriveObserver {
 public:
  static constexpr int kFrames = 10;
  static constexpr double kMovePerFrame_m = 0.02;

  DriveObserver(SensorKind kind, bool correlated, std::uint64_t key, const MappingSettings& mapping);

  /// One more frame: exact depths, to which the sensor adds its noise.
  void see(std::span<const float> depth, int frame, const Pose& T_world_body);

  [[nodiscard]] const SensorSpec& sensor() const { return sensor_.model(); }
  [[nodiscard]] const GridMap& map(bool single_frame) const {
    return (single_frame ? single_ : driven_)->published();
  }

 private:
  [[nodiscard]] std::unique_ptr<FrameStack> new_stack() const;

  MappingSettings mapping_;
  DepthSensor sensor_;
  std::unique_ptr<FrameStack> driven_;
  std::unique_ptr<FrameStack> single_;
};

/// Drives straight up to a pose, which is the last frame's. The two observers, one with independent and one
/// with correlated noise, see the same exact depths.
std::array<DriveObserver, 2> drive_up_to(const Shapes& shapes, const Pose& T_world_body, SensorKind kind,
                                         std::uint64_t key, const MappingSettings& mapping);

}  // namespace floornav
