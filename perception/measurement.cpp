#include "perception/measurement.hpp"

#include <limits>

namespace floornav {

void Measurer::begin(const DepthFrame& frame) {
  pixels_ = frame.pixels;
  uncertainty_ = frame.uncertainty;
  uncertainty_scale_ = frame.uncertainty_scale;
  const Model model{frame.meaning, frame.scale, 1.0F / (frame.camera.fx * frame.baseline_m),
                    frame.disparity_sigma_px};
  if (model == model_) return;
  model_ = model;
  table_.resize(std::numeric_limits<std::uint16_t>::max() + std::size_t{1});
  for (std::size_t count = 0; count < table_.size(); ++count)
    table_[count] = measure(static_cast<std::uint16_t>(count), model.sigma_px);
}

Measurement Measurer::measure(std::uint16_t count, float sigma_px) const {
  constexpr float kMaxDepth_m = 100.0F;
  constexpr float kRounding = 0.288675F;  // deviation of a uniform distribution of width 1
  const float value = static_cast<float>(count) * model_.scale;
  if (!(value > 0.0F)) return {};
  const bool is_depth = model_.meaning == PixelMeaning::kDepth;
  const float inverse_depth = is_depth ? 1.0F / value : value * model_.per_disparity;
  if (!(inverse_depth * kMaxDepth_m > 1.0F)) return {};
  const float sigma = sigma_px * model_.per_disparity;
  const float rounding_m = is_depth ? model_.scale * kRounding : 0.0F;
  const float added = (roughness_m_ * roughness_m_ + rounding_m * rounding_m) * inverse_depth *
                      inverse_depth * inverse_depth * inverse_depth;
  return {inverse_depth, 1.0F / std::sqrt(sigma * sigma + added)};
}

}  // namespace floornav
