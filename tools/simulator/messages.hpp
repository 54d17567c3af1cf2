#pragma once

#include <cstdint>
#include <span>

#include "floornav/depth_cloud_t.hpp"
#include "floornav/pose_t.hpp"
#include "runtime/geometry/pose.hpp"
#include "tools/simulator/depth_sensor.hpp"

namespace floornav {

/// A sensor's image as it goes over the wire; the sender fills in source, session and seq.
depth_cloud_t cloud_message(const DepthSensor& sensor, std::span<const std::uint16_t> pixels,
                            std::int64_t utime_us, std::int64_t frame);

/// A pose with the velocities that lead from `before` to `after` within `span_s`.
pose_t pose_message(std::int64_t utime_us, const Pose& T_world_body, const Pose& before, const Pose& after,
                    double span_s);

}  // namespace floornav
