#include "tools/bench/frame_stack.hpp"

#include "lcmtypes/channels.hpp"
#include "tools/simulator/drive.hpp"
#include "tools/simulator/messages.hpp"

namespace floornav {
namespace {

constexpr std::int64_t kFrame_us = 100'000;
constexpr std::int64_t kPoseMargin_us = 10'000;

}  // namespace

FrameStack::FrameStack(const PerceptionSettings& perception, const MappingSettings& mapping,
                       const RobotSettings& robot)
    : perception_(perception, robot, serial_),
      mapper_(mapping, robot),
      executor_({&perception_, &mapper_}, [this](const EncodedMessage& message, Micros) { hear(message); }),
      out_({"bench", 1}) {}

void FrameStack::hear(const EncodedMessage& message) {
  const auto* const bytes = message.bytes.data();
  const auto size = static_cast<int>(message.bytes.size());
  if (message.channel == channel::kSurfels) surfel_bytes_ += message.bytes.size();
  if (message.channel == channel::kGridMap) {
    grid_map_t map;
    map.decode(bytes, 0, size);
    receiver_.apply(map);
  }
  if (message.channel == channel::kTerrainMap) {
    terrain_map_t map;
    map.decode(bytes, 0, size);
    terrain_.apply(map);
  }
}

void FrameStack::deliver(const EncodedMessage& message, std::int64_t utime_us) {
  executor_.deliver({utime_us, message.channel, message.bytes});
}

void FrameStack::see(const DepthSensor& sensor, std::span<const std::uint16_t> pixels,
                     const Pose& T_world_body) {
  const std::int64_t utime_us = kDriveStart_us + frames_ * kFrame_us;
  const bool is_kinect = sensor.model().kind == SensorKind::kKinect;
  const auto pose = [&](std::int64_t at_us) {
    out_.publish(channel::kPose, pose_message(at_us, T_world_body, T_world_body, T_world_body, 1.0));
  };
  pose(utime_us - kPoseMargin_us);
  out_.publish(is_kinect ? channel::kKinectCloud : channel::kBumblebeeCloud,
               cloud_message(sensor, pixels, utime_us, frames_));
  pose(utime_us + kPoseMargin_us);
  for (const EncodedMessage& message : out_.take()) {
    if (message.channel != channel::kPose) cloud_bytes_ += message.bytes.size();
    deliver(message, utime_us + kPoseMargin_us);
  }
  ++frames_;
}

}  // namespace floornav
