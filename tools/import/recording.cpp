#include "tools/import/recording.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

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

void Recording::check_size(const DepthImage& image) {
  if (clouds_ == 0) {
    width_ = image.width;
    height_ = image.height;
  }
  if (image.width != width_ || image.height != height_)
    throw std::runtime_error(
        fmt::format("is {} x {} px, the first one was {} x {}", image.width, image.height, width_, height_));
}

void Recording::cloud(std::int64_t utime_us, const DepthImage& image, const Pinhole& camera, double scale_m,
                      const Pose& T_body_sensor) {
  check_size(image);
  Pinhole sized = camera;
  sized.width = image.width;
  sized.height = image.height;
  check_intrinsics(sized);
  if (clouds_ == 0) session_ = utime_us;

  depth_cloud_t message{};
  message.utime = utime_us;
  message.source = "floornav-import";
  message.session = session_;
  message.seq = ++clouds_;
  message.sensor = sensor_.kind;
  message.frame = clouds_;
  message.width = static_cast<std::int16_t>(image.width);
  message.height = static_cast<std::int16_t>(image.height);
  message.first_row = 0;
  message.rows = message.height;
  message.fx = camera.fx;
  message.fy = camera.fy;
  message.cx = camera.cx;
  message.cy = camera.cy;
  message.baseline = static_cast<float>(sensor_.baseline_m);
  message.disparity_sigma = static_cast<float>(sensor_.disparity_sigma_px(camera.fx));
  pose_to_arrays(T_body_sensor, message.sensor_pos, message.sensor_orientation);
  message.meaning = depth_cloud_t::DEPTH;
  message.scale = static_cast<float>(scale_m);
  pack_pixels(image.pixels, message);
  log_.write(utime_us, sensor_.channel, encoded(message));
}

void Recording::finish() {
  log_.close();
  std::filesystem::rename(unfinished_, file_);
}

}  // namespace floornav
