#pragma once

#include <cstdint>

#include "runtime/geometry/pose.hpp"
#include "tools/import/import.hpp"

namespace floornav {

/// The sensor in the body frame.
Pose sensor_pose(const FixedMounting& mounting);

/// Where the body stands for a frame without a pose.
Pose place_of(std::int64_t frame, const FixedMounting& mounting);

}  // namespace floornav
