#pragma once

#include <cmath>
#include <cstddef>

#include "perception/depth_frame.hpp"

namespace floornav {

/// What one pixel measured.
struct Measurement {
  float inverse_depth = 0.0F;  ///< 1/m
  float certainty = 0.0F;      ///< m: 1 / (1 sigma of inverse_depth)
  explicit operator bool() const { return inverse_depth > 0.0F; }
};

/// Inverse depth and its certainty by eq. (3) / (4); for depth pixels the rounding to whole counts adds its
/// share. False where nothing came back or the value is absurd.
inline Measurement measure(const DepthFrame& frame, std::size_t pixel, float roughness_m) {
  constexpr float kMaxDepth_m = 100.0F;
  constexpr float kRounding = 0.288675F;  // deviation of a uniform distribution of width 1
  const float value = static_cast<float>(frame.pixels[pixel]) * frame.scale;
  if (!(value > 0.0F)) return {};
  const float per_disparity = 1.0F / (frame.camera.fx * frame.baseline_m);
  float sigma_px = frame.disparity_sigma_px;
  if (!frame.uncertainty.empty() && frame.uncertainty[pixel] != 0)
    sigma_px = static_cast<float>(frame.uncertainty[pixel]) * frame.uncertainty_scale;
  const float sigma = sigma_px * per_disparity;
  const bool is_depth = frame.meaning == PixelMeaning::kDepth;
  const float inverse_depth = is_depth ? 1.0F / value : value * per_disparity;
  if (!(inverse_depth * kMaxDepth_m > 1.0F)) return {};
  const float rounding_m = is_depth ? frame.scale * kRounding : 0.0F;
  const float added = (roughness_m * roughness_m + rounding_m * rounding_m) * inverse_depth * inverse_depth *
                      inverse_depth * inverse_depth;
  return {inverse_depth, 1.0F / std::sqrt(sigma * sigma + added)};
}

}  // namespace floornav
