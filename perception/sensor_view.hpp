#pragma once

#include "perception/depth_frame.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// Where one frame was taken from, and the sensor's error model at that frame.
///
/// Depth noise is uniform in disparity (eq. (3) and (4)): the inverse depth 1/Z = disparity / (fx baseline)
/// has the same deviation at every range, and a plane in space is linear in (ray_x, ray_y, 1/Z).
struct SensorView {
  SensorView(const DepthFrame& frame, const Pose& T_world_body_at_frame)
      : camera(frame.camera),
        T_world_body(T_world_body_at_frame),
        T_body_sensor(frame.T_body_sensor),
        T_world_sensor(T_world_body_at_frame * frame.T_body_sensor),
        disparity_per_inverse_depth(static_cast<double>(frame.camera.fx) *
                                    static_cast<double>(frame.baseline_m)),
        disparity_sigma_px(frame.disparity_sigma_px) {}

  Pinhole camera;
  Pose T_world_body;
  Pose T_body_sensor;
  Pose T_world_sensor;
  double disparity_per_inverse_depth;  ///< fx baseline, px m
  float disparity_sigma_px;
};

}  // namespace floornav
