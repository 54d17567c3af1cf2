#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
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

/// How a device is.
struct CaptureStatus {
  std::string trouble = "starting";           ///< why no frames come, for a person; empty: they come
  const char* doing = nullptr;                ///< the call into the library that is going on
  std::int64_t doing_us = 0;                  ///< for how long
  std::int64_t opened = 0;                    ///< times that the device was opened
  std::map<std::string, std::int64_t> drops;  ///< frames that came, but could not be used or waited too long
};

/// Where a node's frames come from.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Swaps the next frame into `frame`, whose memory is used again. False where none has come since the last
  /// call.
  virtual bool take(CapturedFrame& frame) = 0;
  [[nodiscard]] virtual CaptureStatus status() const = 0;
  /// `arrived` is called on any thread after each frame; empty: no more.
  virtual void notify(std::function<void()> arrived) = 0;
};

}  // namespace floornav
