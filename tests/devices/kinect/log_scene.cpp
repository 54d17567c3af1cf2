#include "tests/devices/kinect/log_scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/pose_t.hpp"
#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "runtime/process/log_reader.hpp"
#include "tests/devices/kinect/scene_writer.hpp"

namespace floornav {
namespace {

template <class Message>
bool decode(const LogEvent& event, Message& message) {
  const int size = static_cast<int>(event.bytes.size());
  return message.decode(event.bytes.data(), 0, size) == size;
}

SceneHeader header_of(const depth_cloud_t& cloud) {
  SceneHeader header;
  header.width = cloud.width;
  header.height = cloud.height;
  header.count_um = 1000;
  header.there_and_back = 1;
  header.horizontal_fov_rad = 2 * std::atan(static_cast<float>(cloud.width) / (2 * cloud.fx));
  header.vertical_fov_rad = 2 * std::atan(static_cast<float>(cloud.height) / (2 * cloud.fy));
  return header;
}

/// Depths in mm, 0 where there is none or one that 16 bits do not hold.
void to_millimetres(const depth_cloud_t& cloud, std::vector<std::uint16_t>& pixels) {
  const double scale = static_cast<double>(cloud.scale);
  const double focal_baseline = static_cast<double>(cloud.fx) * static_cast<double>(cloud.baseline);
  for (std::uint16_t& pixel : pixels) {
    if (pixel == 0) continue;
    const double value = pixel * scale;
    const double mm = 1000 * (cloud.meaning == depth_cloud_t::DEPTH ? value : focal_baseline / value);
    pixel = mm < 65535 ? static_cast<std::uint16_t>(std::lround(mm)) : std::uint16_t{0};
  }
}

}  // namespace

std::int64_t LogScene::log_utime_us(std::int64_t since_first_us) const {
  const std::int64_t length = std::int64_t{frames - 1} * period_us;
  const std::int64_t phase = since_first_us % (2 * length);
  return first_utime_us + std::min(phase, 2 * length - phase);
}

Pose LogScene::body_at(std::int64_t since_first_us) const {
  const std::int64_t utime = log_utime_us(since_first_us);
  const auto later =
      std::find_if(poses.begin(), poses.end(), [&](const auto& p) { return p.utime_us >= utime; });
  if (later == poses.end()) return poses.back().T_world_body;
  if (later == poses.begin()) return poses.front().T_world_body;
  const BodyPose& earlier = *(later - 1);
  const double fraction = static_cast<double>(utime - earlier.utime_us) /
                          static_cast<double>(std::max<std::int64_t>(1, later->utime_us - earlier.utime_us));
  return interpolate(earlier.T_world_body, later->T_world_body, fraction);
}

LogScene write_log_scene(const std::filesystem::path& log, const std::filesystem::path& file,
                         int max_frames) {
  LogScene scene;
  LogReader reader(log);
  LogEvent event;
  depth_cloud_t cloud;
  pose_t pose;
  std::vector<std::uint16_t> pixels;
  std::unique_ptr<SceneWriter> writer;
  SceneHeader header;
  std::int64_t last_utime = 0;
  while (reader.next(event)) {
    if (event.channel == channel::kPose && decode(event, pose))
      scene.poses.push_back({pose.utime, pose_from_arrays(pose.pos, pose.orientation)});
    if (event.channel != channel::kKinectCloud || scene.frames == max_frames || !decode(event, cloud))
      continue;
    if (!writer) {
      header = header_of(cloud);
      writer = std::make_unique<SceneWriter>(file, header);
      scene.first_utime_us = cloud.utime;
    }
    if (cloud.width != header.width || cloud.rows != header.height) continue;
    unpack_pixels(cloud, pixels);
    to_millimetres(cloud, pixels);
    writer->add(pixels);
    last_utime = cloud.utime;
    ++scene.frames;
  }
  if (scene.frames < 2 || scene.poses.empty())
    throw std::runtime_error(log.string() + ": fewer than two whole KINECT_CLOUD frames, or no POSE");
  scene.period_us = static_cast<int>((last_utime - scene.first_utime_us) / (scene.frames - 1));
  writer->close(scene.period_us);
  return scene;
}

}  // namespace floornav
