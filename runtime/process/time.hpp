#pragma once

#include <chrono>

namespace floornav {

/// An instant or a span on a monotonic clock: the machine's when live, the log's in replay. Never compared
/// with a message's utime, which only associates data.
using Micros = std::chrono::microseconds;

}  // namespace floornav
