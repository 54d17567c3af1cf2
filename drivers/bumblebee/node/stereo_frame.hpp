#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/bumblebee/eye_images.hpp"
#include "drivers/bumblebee/rectification.hpp"
#include "drivers/camera/device_clock.hpp"

namespace floornav {

/// Two eyes of an open camera, to be matched.
struct EyePair {
  std::size_t left = 1;  ///< of the layout's eyes
  std::size_t right = 0;
  Rectification rectification;
  double left_shift_m = 0;  ///< how far its left eye stands to the right of the camera's leftmost one
};

/// The stream of an open camera.
struct StereoStream {
  std::string device;  ///< for a person: model, GUID, mode
  FrameLayout layout;
  std::vector<EyePair> pairs;    ///< one, or the wide and the narrow one
  std::int64_t period_us = 0;    ///< between frames
  bool stamped = false;          ///< a FrameStamp is in each
  std::int64_t shortest_way_us;  ///< from mid-exposure to the arrival of a frame that nothing held up
};

/// A raw frame that has come whole.
struct StereoFrame {
  std::shared_ptr<const StereoStream> stream;  ///< a new one each time the camera was opened
  std::vector<std::uint8_t> bytes;             ///< as stream->layout says
  std::int64_t number = 0;                     ///< the camera's own count
  /// Frames that came since the one before and are not handed over.
  std::int64_t dropped_before = 0;
  std::uint64_t stamp = 0;  ///< of the camera's clock, us
  HostTime arrival;
};

}  // namespace floornav
