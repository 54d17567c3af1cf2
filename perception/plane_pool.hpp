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
  std::vector<std::int32_t> block;   ///< RoiCloud::block of the point

  [[nodiscard]] std::size_t size() const { return point.size(); }

  void resize(std::size_t n) {
    for (auto* values : {&ray_x, &ray_y, &inverse_depth, &certainty}) values->resize(n);
    point.resize(n);
    block.resize(n);
  }
  /// Takes place `to` from place `from` of a pool.
  void set(std::size_t to, const PlanePool& other, std::size_t from) {
    ray_x[to] = other.ray_x[from];
    ray_y[to] = other.ray_y[from];
    inverse_depth[to] = other.inverse_depth[from];
    certainty[to] = other.certainty[from];
    point[to] = other.point[from];
    block[to] = other.block[from];
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
      if (end != i) set(end, *this, i);
      ++end;
    }
    resize(end);
  }
};

}  // namespace floornav
