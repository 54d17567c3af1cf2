#include "drivers/camera/frame_gaps.hpp"

#include <algorithm>
#include <utility>

namespace floornav {

std::int64_t FrameGaps::missing_before(std::int64_t number, std::int64_t device_us) {
  const std::int64_t numbers = number - std::exchange(last_number_, number);
  const std::int64_t elapsed_us = device_us - std::exchange(last_device_us_, device_us);
  if (!std::exchange(started_, true) || numbers < 1) return 0;
  const std::int64_t periods = period_us_ > 0 ? (elapsed_us + period_us_ / 2) / period_us_ : 0;
  return std::max(numbers, periods) - 1;
}

}  // namespace floornav
