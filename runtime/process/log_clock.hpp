#pragma once

#include <cstdint>

#include "runtime/process/time.hpp"

namespace floornav {

/// Makes a monotonic clock of the time stamps of a log. It follows them exactly as long as they behave: a
/// stamp slightly older than the newest one leaves it where it is, and where the stamps jump (the wall clock
/// was set, or a stamp is damaged) it stands still for that one message and goes on from there.
class LogClock {
 public:
  static constexpr Micros kMaxBack = std::chrono::seconds(1);
  static constexpr Micros kMaxAhead = std::chrono::seconds(60);

  /// The first stamp sets the clock. Returns now().
  Micros advance(std::int64_t stamp_us);
  /// Lets time pass without a stamp.
  void run_on(Micros span) { now_ += span; }

  [[nodiscard]] Micros now() const { return now_; }
  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] std::int64_t jumps() const { return jumps_; }

 private:
  bool started_ = false;
  Micros now_{0};
  std::int64_t newest_us_ = 0;  ///< stamp that stands for now_
  std::int64_t jumps_ = 0;
};

}  // namespace floornav
