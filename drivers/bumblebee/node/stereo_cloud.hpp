#pragma once

#include "drivers/bumblebee/rectification.hpp"
#include "drivers/bumblebee/stereo_matcher.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// All of a whole frame's message that stays the same from frame to frame. `T_body_sensor`: of the ideal left
/// camera.
depth_cloud_t stereo_cloud(const Pinhole& camera, double baseline_m, const Pose& T_body_sensor);

/// Puts disparities and their uncertainties into it.
void set_disparities(const DisparityImage& image, depth_cloud_t& cloud);

}  // namespace floornav
