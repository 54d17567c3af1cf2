#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "perception/inverse_depth_plane.hpp"
#include "perception/plane_pool.hpp"
#include "perception/pool_kernel.hpp"

namespace floornav {

/// Two planes that meet in an edge of which the outside is seen: a ray meets the one that is farther off.
struct PlanePair {
  std::array<InverseDepthPlane, 2> planes;
  std::array<PlaneFit, 2> fits;  ///< of the points that gave each of them

  [[nodiscard]] bool meets_first(float ray_x, float ray_y) const {
    return planes[0].inverse_depth(ray_x, ray_y) <= planes[1].inverse_depth(ray_x, ray_y);
  }
  /// How far a point of the pool is off what its ray meets, in sigmas.
  [[nodiscard]] float distance(const PlanePool& pool, std::size_t i) const {
    const float x = pool.ray_x[i], y = pool.ray_y[i];
    const float met = std::min(planes[0].inverse_depth(x, y), planes[1].inverse_depth(x, y));
    return std::abs(pool.inverse_depth[i] - met) * pool.certainty[i];
  }
};

/// Takes a plane apart that is a compromise between two: far away a plane's threshold is wider than a small
/// thing is deep, and more points support the plane through its side and its top, or through both of its
/// sides, than either of them.
class PlaneSplitter {
 public:
  /// The two planes that explain the claimed points of the pool much better than the one that claimed them;
  /// nothing where there are no such planes, or the points scatter about theirs as noise makes them.
  /// `distance`: of all points of the pool from that plane, in sigmas.
  std::optional<PlanePair> split(const PlanePool& pool, std::span<const Claim> claims,
                                 std::span<const float> distance, float threshold_sigmas);

  /// Fits each plane to the claimed points whose rays meet it; nothing where those are too few.
  std::optional<PlanePair> refit(const PlanePool& pool, std::span<const Claim> claims, const PlanePair& pair,
                                 float threshold_sigmas);

  /// Whether each of the planes owns enough of the claimed points.
  [[nodiscard]] static bool both_own_points(const PlanePool& pool, std::span<const Claim> claims,
                                            const PlanePair& pair);

 private:
  /// As far as splitting at the middle of their rays' coordinate leads; its cost is the sum of squared
  /// distances.
  struct Split {
    PlanePair pair;
    double cost;
  };
  std::optional<Split> split_at_middle(const PlanePool& pool, const std::vector<float>& coordinate,
                                       float threshold_sigmas);
  void take_claimed(const PlanePool& pool, std::span<const Claim> claims);
  [[nodiscard]] std::optional<PlanePair> refit(const PlanePool& pool, const PlanePair& pair,
                                               float threshold_sigmas) const;

  std::vector<std::size_t> points_;  ///< the claimed ones, indices into the pool
  std::vector<float> values_;
};

}  // namespace floornav
