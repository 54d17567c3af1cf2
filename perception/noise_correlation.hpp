#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "perception/cell_points.hpp"
#include "perception/roi_cloud.hpp"

namespace floornav {

/// Over how many pixels, each way, a frame's noise is alike. Told by the frame's own floor: half the mean
/// squared difference of what two pixels of a row are off their plane grows with their distance up to where
/// they are independent. 1 where they always are, or where too little floor was seen; about n where depth
/// comes out of matching windows of n x n pixels. Rows are taken to speak for columns too.
float alike_length_px(const RoiCloud& cloud, std::span<const std::int16_t> label,
                      std::span<const SectionResult> sections);

/// How many independent measurements the points of a patch are that is `width_px` wide in the image, where
/// the noise is alike over `alike_px`.
inline float independent_measurements(std::int32_t points, float width_px, float alike_px) {
  const auto n = static_cast<float>(points);
  const float columns = std::max(1.0F, width_px / alike_px);
  const float rows = std::max(1.0F, n / (width_px * alike_px));
  return std::min(n, columns * rows);
}

}  // namespace floornav
