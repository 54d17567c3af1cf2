#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// Radial and tangential distortion, in OpenCV's order: k1 k2 p1 p2 k3.
using Distortion = std::array<double, 5>;

/// Where the ray at depth 1 through (x, y) meets the image plane of a lens with this distortion.
Eigen::Vector2d distort(const Eigen::Vector2d& ray, const Distortion& distortion);

/// Takes a lens's distortion out of depth images: each pixel of the ideal camera gets the depth of the
/// nearest pixel of the real one, none where that lies outside. Depths are not mixed: across an edge nothing
/// lies between them.
class Lens {
 public:
  /// Without distortion nothing is changed.
  Lens(const Pinhole& camera, const Distortion& distortion);

  /// `pixels`: an image of the camera's size, row by row.
  void undistort(std::vector<std::uint16_t>& pixels);

 private:
  std::vector<std::int32_t> source_;  ///< index of the real camera's pixel, -1: none; empty: nothing to do
  std::vector<std::uint16_t> result_;
};

}  // namespace floornav
