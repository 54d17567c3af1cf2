#include "tools/import/recording.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "drivers/bumblebee/node/stereo_cloud.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "floornav/pose_t.hpp"
#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_cloud.hpp"

namespace floornav {

namespace {

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int size = static_cast<int>(bytes.size());
  if (message.encode(bytes.data(), 0, size) != size) throw std::logic_error("message does not encode");
  return bytes;
}

std::filesystem::path with_suffix(std::filesystem::path file, const char* suffix) {
  return file += suffix;
}

}  // namespace

Recording::Recording(std::filesystem::path file, const ImportedSensor& sensor)
    : file_(std::move(file)), unfinished_(with_suffix(file_, ".part")), sensor_(sensor), log_(unfinished_) {}

Recording::~Recording() {
  std::error_code ignored;
  std::filesystem::remove(unfinished_, ignored);
}

void Recording::pose(std::int64_t utime_us, const Pose& T_world_body) {
  if (last_pose_utime_ && utime_us <= *last_pose_utime_) return;
  last_pose_utime_ = utime_us;
  pose_t message{};
  message.utime = utime_us;
  pose_to_arrays(T_world_body, message.pos, message.orientation);
  log_.write(utime_us, channel::kPose, encoded(message));
  ++poses_;
}

void Recording::check_size(int width, int height) {
  if (clouds_ == 0) {
    width_ = width;
    height_ = height;
  }
  if (width != width_ || height != height_)
    throw std::runtime_error(
        fmt::format("is {} x {} px, the first one was {} x {}", width, height, width_, height_));
}

depth_cloud_t Recording::begin_cloud(std::int64_t utime_us, int width, int height, const Pinhole& camera,
                                     const Pose& T_body_sensor) {
  check_size(width, height);
  Pinhole sized = camera;
  sized.width = width;
  sized.height = height;
  check_intrinsics(sized);
  if (clouds_ == 0) session_ = utime_us;

  depth_cloud_t message{};
  message.utime = utime_us;
  message.source = "floornav-import";
  message.session = session_;
  message.seq = ++clouds_;
  message.sensor = sensor_.kind;
  message.frame = clouds_;
  message.width = static_cast<std::int16_t>(width);
  message.height = static_cast<std::int16_t>(height);
  message.first_row = 0;
  message.rows = message.height;
  message.fx = camera.fx;
  message.fy = camera.fy;
  message.cx = camera.cx;
  message.cy = camera.cy;
  pose_to_arrays(T_body_sensor, message.sensor_pos, message.sensor_orientation);
  return message;
}

void Recording::write(const depth_cloud_t& cloud) {
  log_.write(cloud.utime, sensor_.channel, encoded(cloud));
}

void Recording::cloud(std::int64_t utime_us, const DepthImage& image, const Pinhole& camera, double scale_m,
                      const Pose& T_body_sensor) {
  depth_cloud_t message = begin_cloud(utime_us, image.width, image.height, camera, T_body_sensor);
  message.baseline = static_cast<float>(sensor_.baseline_m);
  message.disparity_sigma = static_cast<float>(sensor_.disparity_sigma_px(camera.fx));
  message.meaning = depth_cloud_t::DEPTH;
  message.scale = static_cast<float>(scale_m);
  pack_pixels(image.pixels, message);
  write(message);
}

void Recording::cloud(std::int64_t utime_us, const DisparityImage& image, const Pinhole& camera,
                      double baseline_m, const Pose& T_body_sensor) {
  const depth_cloud_t header = begin_cloud(utime_us, image.width, image.height, camera, T_body_sensor);
  depth_cloud_t message = stereo_cloud(camera, baseline_m, T_body_sensor);
  message.utime = header.utime;
  message.source = header.source;
  message.session = header.session;
  message.seq = header.seq;
  message.frame = header.frame;
  set_disparities(image, message);
  write(message);
}

void Recording::finish() {
  log_.close();
  std::filesystem::rename(unfinished_, file_);
}

}  // namespace floornav
