#pragma once

#include <span>
#include <vector>

#include "perception/inverse_depth_plane.hpp"
#include "perception/plane_pool.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// How well points support a plane.
struct PlaneScore {
  float gain = 0.0F;  ///< what the robust cost falls by: the sum of threshold^2 - residual^2 of the inliers
  float inliers = 0.0F;  ///< share of the points
};

/// Of all points of the pool; `threshold` in sigmas. The same bits whatever the instruction set.
PlaneScore score_of(const PlanePool& pool, const InverseDepthPlane& plane, float threshold);

/// The normal equations of the points within `threshold` sigmas of the plane; each counts as often as
/// `weights` says, where it is not empty. The same bits whatever the instruction set and the number of
/// workers. `parts` is scratch memory.
PlaneFit fit_inliers(const PlanePool& pool, const InverseDepthPlane& plane, float threshold,
                     std::span<const float> weights, Parallel& parallel, std::vector<ResidualSums>& parts);

}  // namespace floornav
