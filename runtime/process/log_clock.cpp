#include "runtime/process/log_clock.hpp"

namespace floornav {

Micros LogClock::advance(std::int64_t stamp_us) {
  if (!started_) {
    started_ = true;
    newest_us_ = stamp_us;
    now_ = Micros(stamp_us);
    return now_;
  }
  std::int64_t ahead = 0;
  const bool overflow = __builtin_sub_overflow(stamp_us, newest_us_, &ahead);
  if (overflow || ahead > kMaxAhead.count() || ahead < -kMaxBack.count()) {
    ++jumps_;
    newest_us_ = stamp_us;
  } else if (ahead > 0) {
    newest_us_ = stamp_us;
    now_ += Micros(ahead);
  }
  return now_;
}

}  // namespace floornav
