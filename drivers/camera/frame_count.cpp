#include "drivers/camera/frame_count.hpp"

#include <algorithm>

namespace floornav {

FrameCount::Counted FrameCount::count(const Arrived& arrived) {
  Counted counted;
  counted.utime_us = clock_.utime_of(arrived.stamp, arrived.arrival);
  const std::int64_t missing = gaps_.missing_before(arrived.number, clock_.device_us());
  counted.lost = std::max<std::int64_t>(0, missing - arrived.dropped_before);
  lost_ += counted.lost;
  frame_ += 1 + missing;
  counted.frame = frame_;
  return counted;
}

}  // namespace floornav
