#pragma once

#include <cstdint>
#include <span>

namespace floornav {

/// What a camera writes over the first pixels of each frame.
struct FrameStamp {
  std::uint32_t cycle_time = 0;  ///< of the bus: 7 bits of s, 13 of 1/8000 s, 12 of 1/3072 of that
  std::uint32_t counter = 0;     ///< of frames
};

/// The stamp of a raw frame of 8 bytes or more; takes it out: the pixels get their neighbours' values.
FrameStamp take_stamp(std::span<std::uint8_t> frame);

/// Turns the bus's cycle time, which begins anew every 128 s, into us that go on.
class CycleClock {
 public:
  /// Of a frame that arrived then (any monotonic clock, us).
  std::uint64_t us(std::uint32_t cycle_time, std::int64_t arrival_us);

 private:
  bool started_ = false;
  std::int64_t last_us_ = 0;
  std::int64_t last_arrival_us_ = 0;
};

}  // namespace floornav
