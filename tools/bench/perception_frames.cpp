#include "tools/bench/perception_frames.hpp"

#include <stdexcept>

#include "lcmtypes/channels.hpp"
#include "runtime/geometry/pose_history.hpp"
#include "runtime/process/log_reader.hpp"
#include "tools/bench/bench_scene.hpp"
#include "tools/simulator/depth_sensor.hpp"
#include "tools/simulator/messages.hpp"

namespace floornav {

std::vector<TimedFrame> frames_of_log(const std::filesystem::path& log) {
  LogReader reader(log);
  constexpr std::int64_t kDay_us = 86'400'000'000;
  PoseHistory poses(kDay_us);
  CloudAssembly kinect, bumblebee;
  std::vector<CloudStrips> clouds;
  for (LogEvent event; reader.next(event);) {
    const int size = static_cast<int>(event.bytes.size());
    if (event.channel == channel::kPose) {
      pose_t pose;
      if (pose.decode(event.bytes.data(), 0, size) == size)
        poses.insert(pose.utime, pose_from_arrays(pose.pos, pose.orientation));
    } else if (event.channel == channel::kKinectCloud || event.channel == channel::kBumblebeeCloud) {
      depth_cloud_t cloud;
      if (cloud.decode(event.bytes.data(), 0, size) != size) continue;
      CloudAssembly& assembly = event.channel == channel::kKinectCloud ? kinect : bumblebee;
      if (auto strips = assembly.add(cloud)) clouds.push_back(std::move(*strips));
    }
  }
  std::vector<TimedFrame> frames;
  for (CloudStrips& strips : clouds)
    if (const auto pose = poses.at(strips.front().utime)) frames.push_back({std::move(strips), *pose});
  if (frames.empty()) throw std::runtime_error(log.string() + ": no cloud with a body pose around its time");
  return frames;
}

std::vector<TimedFrame> rendered_frames(SensorKind kind, int count) {
  constexpr std::int64_t kFrame_us = 100'000;
  DepthSensor sensor(kind == SensorKind::kKinect ? floornav::kinect() : floornav::bumblebee(), 1);
  Outbox out({"bench", 1});
  std::vector<TimedFrame> frames;
  CloudAssembly assembly;
  for (int i = 0; i < count; ++i) {
    const auto pixels = sensor.measure(bench_scene(), Pose::Identity(), i);
    out.publish(channel::kKinectCloud, cloud_message(sensor, pixels, (i + 1) * kFrame_us, i));
    for (const EncodedMessage& message : out.take()) {
      depth_cloud_t cloud;
      cloud.decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size()));
      if (auto strips = assembly.add(cloud)) frames.push_back({std::move(*strips), Pose::Identity()});
    }
  }
  return frames;
}

}  // namespace floornav
