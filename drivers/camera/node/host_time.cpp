#include "drivers/camera/node/host_time.hpp"

#include <chrono>

namespace floornav {
namespace {

template <class Clock>
std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
}

}  // namespace

HostTime host_time() {
  constexpr int kAttempts = 5;
  constexpr std::int64_t kQuick_us = 20;
  HostTime best;
  std::int64_t quickest_us = 0;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::int64_t before = now_us<std::chrono::steady_clock>();
    const std::int64_t utime = now_us<std::chrono::system_clock>();
    const std::int64_t took = now_us<std::chrono::steady_clock>() - before;
    if (attempt == 0 || took < quickest_us) {
      best = {before + took / 2, utime};
      quickest_us = took;
    }
    if (took < kQuick_us) break;
  }
  return best;
}

}  // namespace floornav
