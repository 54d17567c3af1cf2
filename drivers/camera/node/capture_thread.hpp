#pragma once

#include <cstdint>

namespace floornav {

/// CLOCK_MONOTONIC, us.
std::int64_t monotonic_us();

/// True where the calling thread now runs before all ordinary ones (SCHED_FIFO 50). What a library starts
/// does not inherit it.
bool claim_capture_priority();

/// What a person is told where it is not allowed.
inline constexpr const char* kNoPriority =
    "frames may be lost on a busy machine: real-time priority is not allowed here (LimitRTPRIO=50 in the "
    "unit, or rtprio in /etc/security/limits.conf)";

}  // namespace floornav
