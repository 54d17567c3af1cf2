#include "drivers/kinect/device_frame.hpp"

#include <cstring>

namespace floornav {
namespace {

/// Copies one row, backwards where `step` is -1; counts the depths that cannot be.
int copy_row(const std::uint8_t* from, std::uint16_t* to, int step, int width, std::uint16_t max_count) {
  int impossible = 0;
  for (int column = 0; column < width; ++column) {
    std::uint16_t depth = 0;
    std::memcpy(&depth, from + std::ptrdiff_t{2} * column, sizeof depth);
    const bool possible = depth <= max_count;
    impossible += possible ? 0 : 1;
    to[std::ptrdiff_t{step} * column] = possible ? depth : std::uint16_t{0};
  }
  return impossible;
}

}  // namespace

FrameFlaw copy_depths(const DeviceFrame& frame, const FrameShape& shape, std::vector<std::uint16_t>& pixels) {
  constexpr int kGarbageShare = 100;
  if (frame.width != shape.width || frame.height != shape.height || frame.width < 1 || frame.height < 1)
    return FrameFlaw::kWrongSize;
  const auto width = static_cast<std::size_t>(frame.width);
  const auto height = static_cast<std::size_t>(frame.height);
  const auto stride = static_cast<std::size_t>(frame.stride);
  if (frame.stride < 0 || stride < 2 * width || frame.size < stride * (height - 1) + 2 * width)
    return FrameFlaw::kCutShort;

  pixels.resize(width * height);
  std::size_t impossible = 0;
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* from = frame.bytes + row * stride;
    std::uint16_t* to = pixels.data() + row * width;
    impossible += static_cast<std::size_t>(
        shape.mirrored ? copy_row(from, to + width - 1, -1, frame.width, shape.max_count)
                       : copy_row(from, to, 1, frame.width, shape.max_count));
  }
  return impossible * kGarbageShare > pixels.size() ? FrameFlaw::kGarbage : FrameFlaw::kNone;
}

}  // namespace floornav
