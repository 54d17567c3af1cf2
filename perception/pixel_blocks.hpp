#pragma once

#include <cstdint>
#include <vector>

#include "perception/inverse_depth_plane.hpp"
#include "perception/plane_pool.hpp"
#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// Says where in the image a plane owns the points near it: in blocks of 8 x 8 pixels where it holds a fair
/// share of all of the section's points. Elsewhere its inliers are an accident: the line where it cuts
/// another plane, or the far tail of the noise around one.
class PixelBlocks {
 public:
  /// Begins a section without points.
  void reset(const Pinhole& camera);
  void add_point(std::int32_t pixel) { ++points_[block_of(pixel)]; }

  /// Counts the plane's inliers among the pool's points; `pixel` is of the cloud that the pool's points
  /// index.
  void count(const PlanePool& pool, const std::vector<std::int32_t>& pixel, const InverseDepthPlane& plane,
             float threshold_sigmas);
  /// Gives up all owned blocks but the connected patch with most inliers.
  void keep_largest_patch();

  /// Share of the inliers among the points of the pixel's block is enough to own it.
  [[nodiscard]] bool owned(std::int32_t pixel) const { return owns(block_of(pixel)); }
  /// The plane holds most of the block's points.
  [[nodiscard]] bool mostly_owned(std::int32_t pixel) const {
    const std::size_t block = block_of(pixel);
    return 2 * inliers_[block] >= points_[block];
  }

 private:
  [[nodiscard]] std::size_t block_of(std::int32_t pixel) const {
    return static_cast<std::size_t>(pixel / width_ / kSide_px * per_row_ + pixel % width_ / kSide_px);
  }
  [[nodiscard]] bool owns(std::size_t block) const {
    return inliers_[block] > 0 && 10 * inliers_[block] >= 3 * points_[block];
  }
  std::int32_t flood(std::size_t first, std::int32_t patch);

  static constexpr std::int32_t kSide_px = 8;
  std::int32_t width_ = 1;                              ///< px, of the image
  std::int32_t per_row_ = 1;                            ///< blocks
  std::vector<std::int32_t> points_, inliers_, patch_;  ///< a block
  std::vector<std::size_t> open_;  ///< blocks of the patch in hand, neighbours not yet seen
};

}  // namespace floornav
