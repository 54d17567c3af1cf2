#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace floornav {

/// A depth frame as a device hands it over; nothing that it says of itself is believed.
struct DeviceFrame {
  const std::uint8_t* bytes = nullptr;
  std::size_t size = 0;     ///< bytes
  int width = 0;            ///< px
  int height = 0;           ///< px
  int stride = 0;           ///< bytes from row to row
  std::int64_t number = 0;  ///< the device's own count
  std::uint64_t stamp = 0;  ///< of the device's clock
};

/// What a frame of the open stream must look like.
struct FrameShape {
  int width = 0;   ///< px
  int height = 0;  ///< px
  bool mirrored = false;
  std::uint16_t max_count = 0;  ///< no depth is greater
};

/// Why a frame cannot be used.
enum class FrameFlaw {
  kNone,
  kWrongSize,  ///< another width or height than the stream's
  kCutShort,   ///< fewer bytes than its rows need
  kGarbage,    ///< more than 1 % of its depths are greater than any can be
};

/// Copies the depths, row by row and the right way round, to `pixels` (resized; its memory is used again). A
/// depth greater than any can be becomes 0. `pixels` holds anything where there is a flaw.
FrameFlaw copy_depths(const DeviceFrame& frame, const FrameShape& shape, std::vector<std::uint16_t>& pixels);

}  // namespace floornav
