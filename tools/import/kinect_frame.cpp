#include "tools/import/kinect_frame.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

namespace floornav {
namespace {

using kinect::depth_msg_t;

constexpr int kLargestSide_px = 4096;

/// The image's bytes, of which there must be two a pixel.
std::vector<std::uint8_t> plain_bytes(const depth_msg_t& message, std::size_t size) {
  if (message.compression == depth_msg_t::COMPRESSION_NONE) {
    if (message.depth_data.size() != size)
      throw std::runtime_error(
          fmt::format("{} bytes for {} x {} px", message.depth_data.size(), message.width, message.height));
    return message.depth_data;
  }
  if (message.compression != depth_msg_t::COMPRESSION_ZLIB)
    throw std::runtime_error(fmt::format("unknown compression {}", message.compression));
  std::vector<std::uint8_t> bytes(size);
  uLongf length = size;  // more does not fit and is an error
  const int status =
      ::uncompress(bytes.data(), &length, message.depth_data.data(), message.depth_data.size());
  if (status != Z_OK || length != size) throw std::runtime_error("damaged zlib data");
  return bytes;
}

/// Depths of the raw shifts, in counts of `scale_m`; 0 where a shift measures nothing.
std::vector<std::uint16_t> depths_of_shifts(double fx, double scale_m) {
  constexpr int kShifts = 2048;
  constexpr int kNoMeasurement = 2047;
  constexpr double kInfinity = 1090;  // shift of a point infinitely far away
  constexpr double kShiftsPerPixel = 8;
  constexpr double kBaseline_m = 0.075;
  constexpr double kFarthest_m = 10;
  std::vector<std::uint16_t> depths(kShifts, 0);
  for (int shift = 0; shift < kNoMeasurement && shift < kInfinity; ++shift) {
    const double depth_m = kShiftsPerPixel * fx * kBaseline_m / (kInfinity - shift);
    if (depth_m <= kFarthest_m)
      depths[static_cast<std::size_t>(shift)] = static_cast<std::uint16_t>(std::lround(depth_m / scale_m));
  }
  return depths;
}

}  // namespace

KinectDepth depth_of(const depth_msg_t& message, double fx) {
  constexpr double kScaleOfShifts_m = 0.0002;
  const bool shifts = message.depth_data_format == depth_msg_t::DEPTH_11BIT;
  const bool millimetres = message.depth_data_format == depth_msg_t::DEPTH_MM ||
                           message.depth_data_format == depth_msg_t::DEPTH_REGISTERED;
  if (!shifts && !millimetres)
    throw std::runtime_error(
        fmt::format("depth format {} is not read: 11 bit or mm", message.depth_data_format));
  if (message.width < 1 || message.height < 1 || message.width > kLargestSide_px ||
      message.height > kLargestSide_px)
    throw std::runtime_error(fmt::format("an image of {} x {} px", message.width, message.height));

  KinectDepth depth;
  depth.image.width = message.width;
  depth.image.height = message.height;
  depth.image.pixels.resize(static_cast<std::size_t>(message.width) *
                            static_cast<std::size_t>(message.height));
  const std::vector<std::uint8_t> bytes =
      plain_bytes(message, depth.image.pixels.size() * sizeof(std::uint16_t));
  for (std::size_t i = 0; i < depth.image.pixels.size(); ++i)
    depth.image.pixels[i] = static_cast<std::uint16_t>(bytes[2 * i] | bytes[2 * i + 1] << 8);
  if (millimetres) return depth;

  depth.scale_m = kScaleOfShifts_m;
  const std::vector<std::uint16_t> table = depths_of_shifts(fx, depth.scale_m);
  for (std::uint16_t& pixel : depth.image.pixels)
    pixel = pixel < table.size() ? table[pixel] : std::uint16_t{0};
  return depth;
}

}  // namespace floornav
