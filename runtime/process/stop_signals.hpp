#pragma once

#include <atomic>

namespace floornav {

/// From the first call on, SIGTERM and SIGINT set the returned flag instead of ending the process; a second
/// one of the kind ends it at once.
const std::atomic<bool>& stop_on_signals();

}  // namespace floornav
