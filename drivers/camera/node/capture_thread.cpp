#include "drivers/camera/node/capture_thread.hpp"

#include <chrono>

#include <sched.h>

namespace floornav {

std::int64_t monotonic_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

bool claim_capture_priority() {
  constexpr int kCapture = 50;
  sched_param param{};
  param.sched_priority = kCapture;
  return ::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &param) == 0;
}

}  // namespace floornav
