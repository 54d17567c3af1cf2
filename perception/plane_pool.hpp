#pragma once

#include <cstdint>
#include <vector>

#include "perception/inverse_depth_plane.hpp"

namespace floornav {

/// The points of a section that are on no plane yet, as structure of arrays.
struct PlanePool {
  std::vector<float> ray_x, ray_y;
  std::vector<float> inverse_depth;  ///< 1/m
  std::vector<float> certainty;      ///< m: 1 / (1 sigma of inverse_depth)
  std::vector<std::int32_t> point;   ///< index in the RoiCloud

  [[nodiscard]] std::size_t size() const { return point.size(); }

  void clear() { resize(0); }

  void add(float x, float y, float inverse, float sure, std::int32_t index) {
    ray_x.push_back(x);
    ray_y.push_back(y);
    inverse_depth.push_back(inverse);
    certainty.push_back(sure);
    point.push_back(index);
  }

  /// Distance from the plane along the ray, in standard deviations of the point's disparity; positive: nearer
  /// to the sensor than the plane.
  [[nodiscard]] float residual(std::size_t i, const InverseDepthPlane& plane) const {
    return (inverse_depth[i] - plane.inverse_depth(ray_x[i], ray_y[i])) * certainty[i];
  }

  /// Keeps the points for which `stays(i)` is true, in their order.
  template <class Predicate>
  void keep_if(Predicate stays) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!stays(i)) continue;
      ray_x[end] = ray_x[i];
      ray_y[end] = ray_y[i];
      inverse_depth[end] = inverse_depth[i];
      certainty[end] = certainty[i];
      point[end] = point[i];
      ++end;
    }
    resize(end);
  }

 private:
  void resize(std::size_t n) {
    for (auto* values : {&ray_x, &ray_y, &inverse_depth, &certainty}) values->resize(n);
    point.resize(n);
  }
};

}  // namespace floornav
