#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/kinect/node/depth_device.hpp"

namespace floornav {

/// A frame that has come whole, the right way round, without distortion.
struct CapturedFrame {
  std::shared_ptr<const DepthStream> stream;  ///< a new one each time the device was opened
  std::vector<std::uint16_t> pixels;          ///< row by row, counts of stream->count_m
  std::int64_t number = 0;                    ///< the device's own count
  /// Frames that came since the one before and are not handed over: CaptureStatus::drops counts them.
  std::int64_t dropped_before = 0;
  std::uint64_t stamp = 0;  ///< of the device's clock
  HostTime arrival;
  ColorImage color;  ///< empty where none came with it
};

}  // namespace floornav
