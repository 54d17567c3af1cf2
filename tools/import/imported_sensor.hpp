#pragma once

#include <cstdint>
#include <string>

#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// Which of the two sensors a recording stands for, with its baseline and its noise by eq. (3) or (4).
struct ImportedSensor {
  std::int8_t kind = 0;           ///< depth_cloud_t.sensor
  const char* channel = nullptr;  ///< where its clouds go
  double baseline_m = 0;
  double noise_per_m = 0;  ///< sigma_z = noise_per_m * Z^2

  /// 1 sigma of the disparity, px, at a focal length in px.
  [[nodiscard]] double disparity_sigma_px(double fx) const { return noise_per_m * fx * baseline_m; }
};

/// "kinect" or "bumblebee". Throws std::invalid_argument for another name.
ImportedSensor imported_sensor(const std::string& name);

/// From "fx,fy,cx,cy" in px. Throws std::runtime_error that says what is wrong.
Pinhole parse_intrinsics(const std::string& text);

/// Throws std::runtime_error where no camera with an image of this size could have these intrinsics.
void check_intrinsics(const Pinhole& camera);

}  // namespace floornav
