#pragma once

#include <cstdint>

#include "drivers/camera/device_clock.hpp"
#include "drivers/camera/frame_gaps.hpp"

namespace floornav {

/// Counts a camera's frames, those included that it lost, and tells when each was exposed.
class FrameCount {
 public:
  /// `shortest_way_us`: as DeviceClock's.
  explicit FrameCount(std::int64_t shortest_way_us) : clock_(shortest_way_us) {}

  /// The device was opened (again): its clock and its numbers begin anew, ours go on. `period_us`: between
  /// frames; 0: gaps in its stamps are no lost frames (a file).
  void begin(std::int64_t shortest_way_us, std::int64_t period_us) {
    clock_ = DeviceClock(shortest_way_us);
    gaps_ = FrameGaps(period_us);
  }

  /// A frame as a device numbers and stamps it.
  struct Arrived {
    std::int64_t number = 0;
    std::uint64_t stamp = 0;
    HostTime arrival;
    std::int64_t dropped_before = 0;  ///< frames before it that came and were not handed over
  };
  struct Counted {
    std::int64_t utime_us = 0;  ///< middle of the exposure
    std::int64_t frame = 0;     ///< counts from 1, lost ones included
    std::int64_t lost = 0;      ///< by the device, just before this one
  };
  Counted count(const Arrived& arrived);

  [[nodiscard]] std::int64_t lost() const { return lost_; }
  [[nodiscard]] const DeviceClock& clock() const { return clock_; }

 private:
  DeviceClock clock_;
  FrameGaps gaps_{0};
  std::int64_t frame_ = 0;
  std::int64_t lost_ = 0;
};

}  // namespace floornav
