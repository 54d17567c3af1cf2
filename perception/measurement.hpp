#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "perception/depth_frame.hpp"

namespace floornav {

/// What one pixel measured.
struct Measurement {
  float inverse_depth = 0.0F;  ///< 1/m
  float certainty = 0.0F;      ///< m: 1 / (1 sigma of inverse_depth)
  explicit operator bool() const { return inverse_depth > 0.0F; }
};

/// Inverse depth of a frame's pixels and its certainty by eq. (3) / (4); for depth pixels the rounding to
/// whole counts adds its share. False where nothing came back or the value is absurd.
class Measurer {
 public:
  /// `roughness_m`: 1 sigma that surfaces and calibration add to the depth.
  explicit Measurer(double roughness_m) : roughness_m_(static_cast<float>(roughness_m)) {}

  /// Takes a frame whose pixels, and uncertainties, outlive the questions.
  void begin(const DepthFrame& frame);

  [[nodiscard]] Measurement operator()(std::size_t pixel) const {
    if (!uncertainty_.empty() && uncertainty_[pixel] != 0)
      return measure(pixels_[pixel], static_cast<float>(uncertainty_[pixel]) * uncertainty_scale_);
    return table_[pixels_[pixel]];
  }
  /// Certainty set aside.
  [[nodiscard]] float inverse_depth(std::size_t pixel) const { return table_[pixels_[pixel]].inverse_depth; }

 private:
  /// What a measurement depends on besides the pixel.
  struct Model {
    PixelMeaning meaning = PixelMeaning::kDepth;
    float scale = 0.0F;
    float per_disparity = 0.0F;  ///< 1/m of inverse depth a px of disparity
    float sigma_px = 0.0F;
    friend bool operator==(const Model&, const Model&) = default;
  };
  [[nodiscard]] Measurement measure(std::uint16_t count, float sigma_px) const;

  float roughness_m_;
  Model model_;
  std::span<const std::uint16_t> pixels_;
  std::span<const std::uint8_t> uncertainty_;
  float uncertainty_scale_ = 0.0F;
  std::vector<Measurement> table_;  ///< of each count, for the frame's own uncertainty
};

}  // namespace floornav
