#include "runtime/process/log_clock.hpp"

#include <algorithm>

namespace floornav {
namespace {

bool is_jump(std::int64_t stamp_us, std::int64_t before_us) {
  std::int64_t ahead = 0;
  if (__builtin_sub_overflow(stamp_us, before_us, &ahead)) return true;
  return ahead > LogClock::kMaxAhead.count() || ahead < -LogClock::kMaxBack.count();
}

}  // namespace

Micros LogClock::advance(std::int64_t stamp_us, std::string_view name) {
  auto place = streams_.find(name);
  if (place == streams_.end()) {
    if (streams_.empty()) now_ = Micros(stamp_us);
    const bool fits = !is_jump(stamp_us, now_.count());
    place = streams_.emplace(name, Stream{stamp_us, fits ? Micros(stamp_us) : now_}).first;
  }
  Stream& stream = place->second;
  if (is_jump(stamp_us, stream.newest_us)) {
    ++jumps_;
    stream = {stamp_us, now_};
  } else if (stamp_us > stream.newest_us) {
    stream.newest += Micros(stamp_us - stream.newest_us);
    stream.newest_us = stamp_us;
  }
  now_ = std::max(now_, stream.newest);
  return now_;
}

}  // namespace floornav
