#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "runtime/geometry/pose.hpp"

namespace floornav {

/// A virtual camera under a live stack.
struct LiveCamera {
  std::string source;          ///< of its driver's messages
  std::string channel;         ///< of its clouds
  int period_us = 0;           ///< between frames
  std::int64_t origin_us = 0;  ///< CLOCK_MONOTONIC of its first frame
  std::function<void()> unplug;
  std::function<void()> plug;
  std::function<void()> stall;  ///< it sends nothing more
  /// CLOCK_MONOTONIC at which the frame of a step was handed to the driver's library; 0: it was not.
  std::function<std::int64_t(std::int64_t step)> raised_us;
  /// Where the body is so long after the first frame.
  std::function<Pose(std::int64_t since_first_us)> body_at;
};

}  // namespace floornav
