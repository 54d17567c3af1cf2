#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "runtime/process/time.hpp"

namespace floornav {

/// Makes a monotonic clock of the time stamps of a log: the newest stamp is now. Each stream of stamps may
/// jump (the wall clock was set, or a stamp is damaged): it is then taken to stand for now, and the clock
/// follows it from there.
class LogClock {
 public:
  /// What one step of a stream may be at most; more is a jump.
  static constexpr Micros kMaxBack = std::chrono::seconds(1);
  static constexpr Micros kMaxAhead = std::chrono::seconds(60);

  /// The first stamp of all sets the clock. Returns now().
  Micros advance(std::int64_t stamp_us, std::string_view stream = "");
  /// Lets time pass without a stamp.
  void run_on(Micros span) { now_ += span; }

  [[nodiscard]] Micros now() const { return now_; }
  [[nodiscard]] bool started() const { return !streams_.empty(); }
  [[nodiscard]] std::int64_t jumps() const { return jumps_; }

 private:
  struct Stream {
    std::int64_t newest_us = 0;  ///< stamp
    Micros newest{0};            ///< the time that it stands for
  };
  Micros now_{0};
  std::map<std::string, Stream, std::less<>> streams_;
  std::int64_t jumps_ = 0;
};

}  // namespace floornav
