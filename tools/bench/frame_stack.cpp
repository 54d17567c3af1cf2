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
  see(cloud_message(sensor, pixels, 0, 0), T_world_body);
}

void FrameStack::see(depth_cloud_t cloud, const Pose& T_world_body) {
  cloud.utime = kDriveStart_us + frames_ * kFrame_us;
  cloud.frame = frames_;
  const auto pose = [&](std::int64_t at_us) {
    out_.publish(channel::kPose, pose_message(at_us, T_world_body, T_world_body, T_world_body, 1.0));
  };
  pose(cloud.utime - kPoseMargin_us);
  out_.publish(cloud.sensor == depth_cloud_t::KINECT ? channel::kKinectCloud : channel::kBumblebeeCloud,
               cloud);
  pose(cloud.utime + kPoseMargin_us);
  for (const EncodedMessage& message : out_.take()) {
    if (message.channel != channel::kPose) cloud_bytes_ += message.bytes.size();
    deliver(message, cloud.utime + kPoseMargin_us);
  }
  ++frames_;
}

}  // namespace floornav
