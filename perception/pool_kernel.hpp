#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "perception/inverse_depth_plane.hpp"
#include "perception/plane_pool.hpp"
#include "perception/reach.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// What a plane says of a point.
enum class Claim : std::uint8_t { kNone, kPoint, kNoise };

/// Writes how far each point of the pool is off the plane, in sigmas.
void find_distances(const PlanePool& pool, const InverseDepthPlane& plane, Parallel& parallel,
                    std::span<float> distance);

/// Writes kPoint where a point of the pool may lie on floor that the robot can come to, else kNone. `R` turns
/// the sensor frame level, `sensor` is its place above the body's origin; a point's noise counts three times.
void find_reachable(const PlanePool& pool, const Eigen::Matrix3f& R, const Eigen::Vector3f& sensor,
                    const Reach& reach, float slack_m, Parallel& parallel, std::span<Claim> reachable);

/// Of each point: within `threshold` in a block that the plane owns, it is the plane's; up to `noise_band`
/// times as far off in a block that it mostly owns, it is its noise. `block_states`: see PixelBlocks. Returns
/// the number of the plane's points.
int find_claims(const PlanePool& pool, std::span<const float> distance, float threshold, float noise_band,
                std::span<const std::int32_t> block_states, Parallel& parallel, std::span<Claim> claims);

/// Arrays of points from which some are to be taken.
struct PoolSource {
  const float *ray_x, *ray_y, *inverse_depth, *certainty;
  const std::int32_t* block;
  const std::int32_t* point;  ///< null: the points are numbered from first_point
  std::int32_t first_point;
  std::size_t size;
};
PoolSource source_of(const PlanePool& pool);

/// Fills `out` with the points of the source that are marked with `wanted`, in their order. `out` may be the
/// pool that is the source.
void take_points(const PoolSource& source, std::span<const Claim> claims, Claim wanted, PlanePool& out);

}  // namespace floornav
