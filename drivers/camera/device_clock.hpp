#pragma once

#include <cstdint>
#include <optional>

namespace floornav {

/// One instant on the host's two clocks.
struct HostTime {
  std::int64_t monotonic_us = 0;
  std::int64_t utime_us = 0;  ///< wall clock, us since the epoch
};

/// Maps a camera's clock to utime. A frame cannot arrive before it was taken: of what arrival minus stamp was
/// lately, the least is the offset of the two clocks plus the shortest way, and what lies above it is jitter.
/// The offset may grow slowly, since the camera's clock may be slow, and moves by little from frame to frame,
/// so that the distance of two utimes is that of their stamps to 1 %. The wall clock is followed at once,
/// steps and all, since whatever else is associated by utime follows it too.
///
/// Stamps are us, or raw counts of a Kinect's 60 MHz clock, which is found out; either may wrap at 32 bits.
class DeviceClock {
 public:
  /// `shortest_way_us`: from the middle of the exposure to the arrival of a frame that nothing held up.
  explicit DeviceClock(std::int64_t shortest_way_us) : shortest_way_us_(shortest_way_us) {}

  /// utime of the middle of the exposure of a frame stamped `stamp` that has arrived now.
  std::int64_t utime_of(std::uint64_t stamp, HostTime arrival);

  /// utime of something else that the camera stamped within a second of the last frame.
  [[nodiscard]] std::int64_t utime_near_last(std::uint64_t stamp) const;

  /// Of the last frame on the camera's clock, us since the first one; goes on over gaps, but not over
  /// restarts().
  [[nodiscard]] std::int64_t device_us() const { return device_us_; }
  /// Times that the stamps made no sense beside the arrivals (a clock set anew, a file that began again).
  [[nodiscard]] std::int64_t restarts() const { return restarts_; }

 private:
  void start(std::uint64_t stamp, HostTime arrival);
  std::optional<std::int64_t> elapsed_us(std::uint64_t stamp, HostTime arrival);
  void follow(std::int64_t least_offset_us, std::int64_t elapsed_us);

  std::int64_t shortest_way_us_;
  bool started_ = false;
  int stamps_per_us_ = 0;  ///< 1 or 60; 0 until two frames have told
  std::uint64_t last_stamp_ = 0;
  std::int64_t last_arrival_us_ = 0;
  std::int64_t stamp_remainder_ = 0;  ///< counts that did not make a whole us yet
  std::int64_t device_us_ = 0;
  double least_offset_us_ = 0;  ///< host minus device, least of late
  double offset_us_ = 0;        ///< the one in use: follows the least one smoothly
  int late_frames_ = 0;         ///< in a row, all later than the offset explains
  std::int64_t restarts_ = 0;
  std::int64_t last_utime_us_ = 0;
};

}  // namespace floornav
