#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "perception/depth_frame.hpp"

namespace floornav {

/// An upright box on the world's axes; floors are boxes too.
struct Box {
  Eigen::Vector3d low, high;
};

/// Rendered by the closed form of a ray's way through boxes (slabs); shares nothing with perception but the
/// frame type.
struct RenderedScene {
  std::vector<Box> boxes;
  double floor_slope = 0.0;  ///< the endless floor: z = floor_slope * x
  bool has_floor = true;
  std::optional<Box> hole;  ///< no floor within its x and y
  double noise_px = 0.067;  ///< 1 sigma of disparity
  double missing_share = 0.0;
  unsigned seed = 1;

  Pinhole camera{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};
  float baseline_m = 0.075F;
  Pose T_world_body = Pose::Identity();
  Pose T_body_sensor = Pose::Identity();
  std::vector<std::uint16_t> pixels;

  void mount(double height_m, double pitch_down_deg, double roll_deg = 0.0) {
    Eigen::Matrix3d axes;  // sensor x right, y down, z forward in the body's x forward, y left, z up
    axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    const double degree = std::numbers::pi / 180.0;
    T_body_sensor = Pose::Identity();
    T_body_sensor.linear() = (Eigen::AngleAxisd(pitch_down_deg * degree, Eigen::Vector3d::UnitY()) *
                              Eigen::AngleAxisd(roll_deg * degree, Eigen::Vector3d::UnitX()))
                                 .toRotationMatrix() *
                             axes;
    T_body_sensor.translation() = Eigen::Vector3d(0, 0, height_m);
  }

  /// Depth along the optical axis of what the ray hits, infinity for nothing. `ray` has depth 1.
  [[nodiscard]] double depth_along(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const {
    double nearest = std::numeric_limits<double>::infinity();
    if (has_floor) {
      const double t = (floor_slope * origin.x() - origin.z()) / (ray.z() - floor_slope * ray.x());
      const Eigen::Vector3d p = origin + t * ray;
      const bool in_hole = hole && p.x() > hole->low.x() && p.x() < hole->high.x() && p.y() > hole->low.y() &&
                           p.y() < hole->high.y();
      if (t > 0 && !in_hole) nearest = t;
    }
    for (const Box& box : boxes) {
      double enter = 0.0, leave = nearest;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.low[axis] - origin[axis]) / ray[axis],
                     b = (box.high[axis] - origin[axis]) / ray[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter < leave) nearest = std::min(nearest, enter);
    }
    return nearest;
  }

  DepthFrame render(std::int64_t utime_us = 1'000'000) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Pose T_world_sensor = T_world_body * T_body_sensor;
    const double per_inverse_depth = static_cast<double>(camera.fx) * static_cast<double>(baseline_m);
    pixels.assign(static_cast<std::size_t>(camera.width * camera.height), 0);
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = camera.ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
        const double depth = depth_along(T_world_sensor.translation(), T_world_sensor.linear() * ray);
        if (!std::isfinite(depth) || share(generator) < missing_share) continue;
        const double disparity = per_inverse_depth / depth + noise_px * noise(generator);
        const double counts = std::round(per_inverse_depth / disparity * 1000.0);
        if (counts > 0 && counts < 10000)
          pixels[static_cast<std::size_t>(v * camera.width + u)] = static_cast<std::uint16_t>(counts);
      }
    DepthFrame frame;
    frame.utime_us = utime_us;
    frame.camera = camera;
    frame.scale = 0.001F;
    frame.pixels = pixels;
    frame.baseline_m = baseline_m;
    frame.disparity_sigma_px = static_cast<float>(std::max(noise_px, 0.01));
    frame.T_body_sensor = T_body_sensor;
    return frame;
  }
};

}  // namespace floornav
