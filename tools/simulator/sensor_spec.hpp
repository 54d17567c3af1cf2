#pragma once

#include <cstdint>
#include <string>

#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

enum class SensorKind : std::uint8_t { kKinect, kBumblebee };

/// How a sensor errs. Everything is in pixels of the sensor's own full resolution, where the noise is
/// uniform.
struct DisparityNoise {
  double sigma_px = 0.068;    ///< of the disparity, in all: random part and quantisation, eq. (3) / (4)
  double quantum_px = 0.125;  ///< step of the disparity; 0: continuous
  int correlation_px =
      1;  ///< 1: independent pixels; n: alike within windows of n x n, as block matching makes it
  double missing = 0.01;     ///< share of pixels without return
  double flying = 0.4;       ///< share of an edge's pixels that fall between its two sides
  bool shadow = true;        ///< what the projector (or the other camera) does not see has no return
  double distortion_px = 0;  ///< amplitude of a fixed, slowly changing error over the image
};

/// One sensor at one resolution, mounted on a robot.
struct SensorSpec {
  SensorKind kind = SensorKind::kKinect;
  Pinhole camera;      ///< of the image that it gives
  int decimation = 1;  ///< own pixels of the sensor per pixel given, each way
  double baseline_m = 0.075;
  double other_eye = 1;  ///< the projector or other camera is to the right (+1) or the left (-1)
  double min_range_m = 0.5;
  double max_range_m = 8.0;
  double rate_hz = 30.0;
  DisparityNoise noise;
  Pose T_body_sensor = Pose::Identity();
};

/// A camera `height_m` above the floor at (x, y) of the body, looking along the body's x axis, `pitch_deg`
/// down and rolled to its right by `roll_deg`.
Pose mounted(double x_m, double y_m, double height_m, double pitch_deg, double roll_deg = 0.0);

/// A Kinect, 640 x 480 at 30 Hz, or every n-th pixel of it. sigma_z = 1.4 cm at 3 m and 3.9 cm at 5 m, eq.
/// (3). `width` must divide 640. Throws std::invalid_argument otherwise.
SensorSpec kinect(int width = 640);

/// A Bumblebee XB3 with its wide baseline, 1280 x 960 at 7.5 Hz (sigma_z = 0.35 cm at 3 m, eq. (4)) or 640 x
/// 480 at 15 Hz, where the same error in pixels weighs twice, or every n-th pixel of either. `native_width`
/// is 1280 or 640 and `width` must divide it.
SensorSpec bumblebee(int native_width = 1280, int width = 1280);

}  // namespace floornav
