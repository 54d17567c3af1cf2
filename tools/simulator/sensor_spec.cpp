#include "tools/simulator/sensor_spec.hpp"

#include <stdexcept>
#include <string>

#include "tools/simulator/portable_math.hpp"

namespace floornav {
namespace {

constexpr double kDefaultHeight_m = 0.72;
constexpr double kDefaultPitch_deg = 20.0;

/// The camera whose pixel looks through the middle of a square of n x n pixels of the full one.
Pinhole decimated(const Pinhole& full, int n) {
  const auto f = static_cast<float>(n);
  const float shift = 0.5F * (f - 1.0F);
  return {full.fx / f,           full.fy / f,    (full.cx - shift) / f,
          (full.cy - shift) / f, full.width / n, full.height / n};
}

int decimation_of(const Pinhole& full, int width) {
  if (width < 16 || full.width % width != 0 || full.height % (full.width / width) != 0)
    throw std::invalid_argument("a width of " + std::to_string(width) + " px: must divide " +
                                std::to_string(full.width) + " and be 16 or more");
  return full.width / width;
}

}  // namespace

Pose mounted(double x_m, double y_m, double height_m, double pitch_deg, double roll_deg) {
  const SinCos p = sin_cos_deg(pitch_deg);
  const SinCos r = sin_cos_deg(roll_deg);
  const Eigen::Vector3d forward(p.cos, 0.0, -p.sin);
  const Eigen::Vector3d right(0.0, -1.0, 0.0);
  const Eigen::Vector3d down = forward.cross(right);
  Pose pose = Pose::Identity();
  pose.linear().col(0) = r.cos * right + r.sin * down;
  pose.linear().col(1) = r.cos * down - r.sin * right;
  pose.linear().col(2) = forward;
  pose.translation() = Eigen::Vector3d(x_m, y_m, height_m);
  return pose;
}

SensorSpec kinect(int width) {
  const Pinhole full{575.0F, 575.0F, 319.5F, 239.5F, 640, 480};
  SensorSpec model;
  model.decimation = decimation_of(full, width);
  model.camera = decimated(full, model.decimation);
  model.T_body_sensor = mounted(0.0, 0.0, kDefaultHeight_m, kDefaultPitch_deg);
  return model;
}

SensorSpec bumblebee(int native_width, int width) {
  if (native_width != 1280 && native_width != 640)
    throw std::invalid_argument("a Bumblebee gives images 1280 or 640 px wide");
  const Pinhole wide{983.0F, 983.0F, 644.0F, 493.0F, 1280, 960};
  const Pinhole full = decimated(wide, 1280 / native_width);
  SensorSpec model;
  model.kind = SensorKind::kBumblebee;
  model.decimation = decimation_of(full, width);
  model.camera = decimated(full, model.decimation);
  model.baseline_m = 0.24;
  model.other_eye = -1;
  model.min_range_m = 0.8;
  model.max_range_m = 12.0;
  model.rate_hz = native_width == 1280 ? 7.5 : 15.0;
  model.noise.sigma_px = 0.0917;
  model.noise.quantum_px = 1.0 / 16.0;
  model.T_body_sensor = mounted(0.0, 0.0, kDefaultHeight_m, kDefaultPitch_deg);
  return model;
}

}  // namespace floornav
