#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "perception/inverse_depth_plane.hpp"
#include "perception/plane_pool.hpp"
#include "perception/random.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// What plane is wanted (section 4.5).
struct PlaneQuery {
  float threshold_sigmas = 2.5F;  ///< alpha
  int max_hypotheses = 200;
  /// In the sensor frame: planes with this normal are tried besides any others.
  std::optional<Eigen::Vector3f> expected_normal;
  float cos_tolerance = -1.0F;  ///< cosine of E: least cosine between a plane's normal and the expected one

  [[nodiscard]] bool admits(const InverseDepthPlane& plane) const {
    return !expected_normal || plane.normal().dot(*expected_normal) >= cos_tolerance;
  }
};

/// Scratch memory of find_plane.
struct RansacScratch {
  PlanePool sample;
  std::vector<ResidualSums> parts;  ///< of a fit
  std::int64_t hypotheses = 0;      ///< scored so far, in all calls
};

/// The plane that most points of the pool support: RANSAC with a robust cost (MSAC: the sum of squared
/// residuals, each at most the threshold's) in disparity space, scored on a sample of the pool, each new best
/// hypothesis refined on its inliers, the last one on all of the pool's. Nothing where no admitted plane was
/// found.
std::optional<InverseDepthPlane> find_plane(const PlanePool& pool, const PlaneQuery& query, Random& random,
                                            Parallel& parallel, RansacScratch& scratch);

}  // namespace floornav
