#pragma once

#include <cstdint>

#include "perception/measured_image.hpp"

namespace floornav {

/// What is less is no step from one pixel to the next.
struct LeastStep {
  float sigmas;   ///< of one pixel
  float depth_m;  ///< along the ray
};

/// Finds the pixels of a row that measured something and may differ by a step from the one before or the one
/// above them; where that one measured nothing the next one counts, and where that did not either, they may.
/// Writes their columns to `columns`, in order, which has room for `image.stride` of them, and returns how
/// many they are. A pixel at the image's border counts as like what is beyond, or not.
std::int32_t find_steps(const MeasuredImage& image, int row, const LeastStep& least, std::int32_t* columns);

}  // namespace floornav
