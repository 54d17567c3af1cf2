#pragma once

#include <cstdint>
#include <vector>

#include "perception/inverse_depth_plane.hpp"

namespace floornav {

/// The points of a section that are on no plane yet, as structure of arrays. The arrays never shrink: what
/// lies behind size() is left over.
struct PlanePool {
  std::vector<float> ray_x, ray_y;
  std::vector<float> inverse_depth;  ///< 1/m
  std::vector<float> certainty;      ///< m: 1 / (1 sigma of inverse_depth)
  std::vector<std::int32_t> point;   ///< index in the RoiCloud
  std::vector<std::int32_t> block;   ///< RoiCloud::block of the point

  [[nodiscard]] std::size_t size() const { return size_; }

  void resize(std::size_t n) {
    size_ = n;
    if (n <= point.size()) return;
    for (auto* values : {&ray_x, &ray_y, &inverse_depth, &certainty}) values->resize(n);
    point.resize(n);
    block.resize(n);
  }

  /// Distance from the plane along the ray, in standard deviations of the point's disparity; positive: nearer
  /// to the sensor than the plane.
  [[nodiscard]] float residual(std::size_t i, const InverseDepthPlane& plane) const {
    return (inverse_depth[i] - plane.inverse_depth(ray_x[i], ray_y[i])) * certainty[i];
  }

 private:
  std::size_t size_ = 0;
};

}  // namespace floornav
