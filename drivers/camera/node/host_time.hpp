#pragma once

#include "drivers/camera/device_clock.hpp"

namespace floornav {

/// Now, on both clocks at once: to some 10 us even where the thread is held up in between.
HostTime host_time();

}  // namespace floornav
