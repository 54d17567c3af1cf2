#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/inverse_depth_plane.hpp"
#include "perception/plane_pool.hpp"
#include "perception/roi_cloud.hpp"

namespace floornav {

/// The lower border of a plane's patch in the image. Below a top there is its side, of which the upper rows
/// lie as near to the top's plane as noise throws its points: they pass for its points, all of them too far
/// away, and tilt it.
class LowerBorder {
 public:
  /// Sets the weights of the points next to the border to 0: of as many rows as the plane takes to leave a
  /// side by the threshold, or most of it. Does nothing where few points would be left, or so near that the
  /// threshold is narrower than 3 cm. Points of weight 0 are not the plane's.
  void leave_out(const PlanePool& pool, const RoiCloud& cloud, const Pinhole& camera,
                 const InverseDepthPlane& plane, float threshold_sigmas, std::span<float> weights);

 private:
  [[nodiscard]] bool is_next_to(std::int32_t pixel, std::int32_t width, std::int32_t rows) const {
    return pixel / width + rows > last_row_[static_cast<std::size_t>(pixel % width)];
  }

  std::vector<std::int32_t> last_row_;  ///< of a column of the image, -1: none
};

}  // namespace floornav
