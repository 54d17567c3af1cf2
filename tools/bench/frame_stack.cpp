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
      executor_({&perception_, &mapper_},
                [this](const EncodedMessage& message, Micros) {
                  if (message.channel != channel::kGridMap) return;
                  grid_map_t map;
                  map.decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size()));
                  receiver_.apply(map);
                }),
      out_({"bench", 1}) {}

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
  for (const EncodedMessage& message : out_.take()) deliver(message, utime_us + kPoseMargin_us);
  ++frames_;
}

}  // namespace floornav
