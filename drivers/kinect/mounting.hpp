#pragma once

#include "drivers/kinect/settings.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// Maps sensor axes (x right, y down, z forward) to the body frame (x forward, y left, z up).
Pose sensor_in_body(const MountingSettings& mounting);

}  // namespace floornav
