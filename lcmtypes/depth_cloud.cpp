#include "lcmtypes/depth_cloud.hpp"

#include <cmath>
#include <string>

namespace floornav {
namespace {

constexpr double kLongestFocalLength_px = 1e5;
constexpr double kLongestBaseline_m = 10.0;
constexpr double kLargestDisparitySigma_px = 100.0;
constexpr double kLargestScale = 100.0;        // m or px a count
constexpr double kFarthestSensor_m = 100.0;    // from the body's origin
constexpr double kQuaternionTolerance = 0.01;  // of its norm

void require(bool holds, const char* what) {
  if (!holds) throw CorruptDepth(std::string("depth cloud: ") + what);
}

/// NaN and infinity are not within.
bool within(double value, double least, double most) {
  return value >= least && value <= most;
}

bool positive(double value, double most) {
  return value > 0 && value <= most;
}

void check_layout(const depth_cloud_t& c) {
  require(c.width > 0 && c.height > 0, "width or height is not positive");
  require(c.first_row >= 0 && c.rows > 0 && c.first_row + c.rows <= c.height, "strip lies outside the frame");
  require(static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height) <= kMostDepthPixels,
          "more than 2^24 - 1 pixels");
}

void check_camera(const depth_cloud_t& c) {
  require(c.sensor == depth_cloud_t::KINECT || c.sensor == depth_cloud_t::BUMBLEBEE, "unknown sensor");
  require(within(c.fx, 1, kLongestFocalLength_px) && within(c.fy, 1, kLongestFocalLength_px),
          "absurd focal length");
  require(within(c.cx, -c.width, 2.0 * c.width) && within(c.cy, -c.height, 2.0 * c.height),
          "absurd principal point");
  require(positive(c.baseline, kLongestBaseline_m), "absurd baseline");
  require(positive(c.disparity_sigma, kLargestDisparitySigma_px), "absurd disparity noise");
}

void check_sensor_pose(const depth_cloud_t& c) {
  for (const double p : c.sensor_pos)
    require(within(p, -kFarthestSensor_m, kFarthestSensor_m), "absurd sensor position");
  double norm2 = 0;
  for (const double q : c.sensor_orientation) norm2 += q * q;
  require(within(std::sqrt(norm2), 1 - kQuaternionTolerance, 1 + kQuaternionTolerance),
          "sensor orientation is no unit quaternion");
}

void check_pixels(const depth_cloud_t& c) {
  require(c.meaning == depth_cloud_t::DEPTH || c.meaning == depth_cloud_t::DISPARITY, "unknown meaning");
  require(positive(c.scale, kLargestScale), "absurd scale");
  require(c.size >= 0 && c.data.size() == static_cast<std::size_t>(c.size), "size is not that of data");
  require(c.uncertainty.size() == static_cast<std::size_t>(c.uncertainty_size) &&
              (c.uncertainty.empty() || c.uncertainty_size == c.width * c.rows),
          "uncertainty plane is not the strip's size");
  require(c.uncertainty.empty() || positive(c.uncertainty_scale, kLargestDisparitySigma_px),
          "absurd uncertainty scale");
}

}  // namespace

void unpack_pixels(const depth_cloud_t& cloud, std::vector<std::uint16_t>& pixels) {
  check_layout(cloud);
  check_camera(cloud);
  check_sensor_pose(cloud);
  check_pixels(cloud);
  pixels.resize(static_cast<std::size_t>(cloud.width) * static_cast<std::size_t>(cloud.rows));
  switch (cloud.encoding) {
    case depth_cloud_t::RVL:
      return decode_rvl(cloud.data, pixels);
    case depth_cloud_t::RAW16:
      return decode_raw16(cloud.data, pixels);
    default:
      throw CorruptDepth("depth cloud: unknown encoding");
  }
}

void pack_pixels(std::span<const std::uint16_t> pixels, depth_cloud_t& cloud) {
  encode_rvl(pixels, cloud.data);
  cloud.encoding = depth_cloud_t::RVL;
  if (cloud.data.size() > 2 * pixels.size()) {
    encode_raw16(pixels, cloud.data);
    cloud.encoding = depth_cloud_t::RAW16;
  }
  cloud.size = static_cast<std::int32_t>(cloud.data.size());
}

}  // namespace floornav
