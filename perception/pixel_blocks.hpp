#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/plane_pool.hpp"
#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// Says where in the image a plane owns the points near it: in blocks of 8 x 8 pixels where it holds a fair
/// share of all of the section's points. Elsewhere its inliers are an accident: the line where it cuts
/// another plane, or the far tail of the noise around one.
class PixelBlocks {
 public:
  static constexpr std::int32_t kSide_px = 8;
  [[nodiscard]] static std::int32_t per_row(const Pinhole& camera) {
    return (camera.width + kSide_px - 1) / kSide_px;
  }

  /// Begins a section with the pool's points.
  void begin(const Pinhole& camera, const PlanePool& pool);
  /// Counts the plane's inliers among the pool's points: those at most `threshold_sigmas` off it.
  void count(const PlanePool& pool, std::span<const float> distance, float threshold_sigmas);
  /// Gives up all owned blocks but the connected patch with most inliers.
  void keep_largest_patch();

  /// Settles the states.
  void judge();

  static constexpr std::int32_t kOwned = 1;        ///< the inliers' share of the block's points is fair
  static constexpr std::int32_t kMostlyOwned = 2;  ///< the plane holds most of the block's points
  /// Of each block: the sum of what holds of it.
  [[nodiscard]] std::span<const std::int32_t> states() const { return state_; }

 private:
  [[nodiscard]] bool owns(std::size_t block) const {
    return inliers_[block] > 0 && 10 * inliers_[block] >= 3 * points_[block];
  }
  std::int32_t flood(std::size_t first, std::int32_t patch);

  std::size_t columns_ = 1;
  std::size_t begin_ = 0, end_ = 0;  ///< rows of blocks that hold the section's points
  std::vector<std::int32_t> points_, inliers_, patch_, state_;  ///< a block
  std::vector<std::size_t> open_;  ///< blocks of the patch in hand, neighbours not yet seen
};

}  // namespace floornav
