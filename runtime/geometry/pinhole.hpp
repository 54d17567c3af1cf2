#pragma once

#include <Eigen/Core>

namespace floornav {

/// An ideal camera: x right, y down, z forward; pixel (column u, row v) looks along ((u-cx)/fx, (v-cy)/fy,
/// 1).
struct Pinhole {
  float fx = 525.0F;  ///< px
  float fy = 525.0F;  ///< px
  float cx = 319.5F;  ///< px
  float cy = 239.5F;  ///< px
  int width = 640;    ///< px
  int height = 480;   ///< px

  /// The point at depth 1 on the pixel's ray.
  [[nodiscard]] Eigen::Vector3f ray(float u, float v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0F}; }
  /// Pixel of a point with z > 0.
  [[nodiscard]] Eigen::Vector2f project(const Eigen::Vector3f& p) const {
    return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
  }
};

}  // namespace floornav
