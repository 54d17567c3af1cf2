#pragma once

#include <cstdint>

namespace floornav {

/// Counts the frames that never came, from the numbers that the camera gives them, and, for a camera whose
/// numbers count only what was delivered, from its clock.
class FrameGaps {
 public:
  /// `period_us` between frames; 0: the clock says nothing (a file).
  explicit FrameGaps(std::int64_t period_us) : period_us_(period_us) {}

  /// Frames missing between the last one and this one, `device_us` by the camera's clock. A number that goes
  /// back begins a new count.
  std::int64_t missing_before(std::int64_t number, std::int64_t device_us);

  /// The next frame is the first one again.
  void restart() { started_ = false; }

 private:
  std::int64_t period_us_;
  bool started_ = false;
  std::int64_t last_number_ = 0;
  std::int64_t last_device_us_ = 0;
};

}  // namespace floornav
