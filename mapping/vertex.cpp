#include "mapping/vertex.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floornav {
namespace {

/// A plane's surface moved along its gradient to the centre of the square.
Surface at_center(const Surface& surface, std::size_t index, std::int32_t side, float pitch_m) {
  if (surface.column) return surface;
  const float half = 0.5F * static_cast<float>(side - 1);
  const float right_m = (half - static_cast<float>(static_cast<std::int32_t>(index) % side)) * pitch_m;
  const float up_m = (half - static_cast<float>(static_cast<std::int32_t>(index) / side)) * pitch_m;
  Surface moved = surface;
  moved.z_m += surface.gradient_x * right_m + surface.gradient_y * up_m;
  return moved;
}

/// The mean of planes, weighted by the inverse of their variances.
class MeanSurface {
 public:
  void add(const Surface& surface) {
    const double weight = 1.0 / static_cast<double>(surface.var_m2);
    weight_ += weight;
    z_ += weight * static_cast<double>(surface.z_m);
    gradient_x_ += weight * static_cast<double>(surface.gradient_x);
    gradient_y_ += weight * static_cast<double>(surface.gradient_y);
  }
  [[nodiscard]] bool empty() const { return weight_ == 0; }
  [[nodiscard]] Surface mean() const {
    return {.z_m = static_cast<float>(z_ / weight_),
            .var_m2 = static_cast<float>(1.0 / weight_),
            .gradient_x = static_cast<float>(gradient_x_ / weight_),
            .gradient_y = static_cast<float>(gradient_y_ / weight_)};
  }

 private:
  double weight_ = 0;
  double z_ = 0;
  double gradient_x_ = 0;
  double gradient_y_ = 0;
};

}  // namespace

float slope_deg(const Surface& surface) {
  return std::atan(std::hypot(surface.gradient_x, surface.gradient_y)) * (180.0F / std::numbers::pi_v<float>);
}

SquareSummary summarise(std::span<const CellMemory> cells, std::int32_t side, float pitch_m, float step_m) {
  SquareSummary summary;
  MeanSurface planes;
  Surface highest;
  Surface lowest;
  const Surface* highest_in_place = nullptr;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Surface* decider = cells[i].decider();
    if (decider == nullptr) continue;
    summary.stepped = summary.stepped || cells[i].is_stepped(step_m);
    const Surface surface = at_center(*decider, i, side, pitch_m);
    if (!summary.seen || surface.z_m > highest.z_m) {
      highest = surface;
      highest_in_place = decider;
    }
    if (!summary.seen || surface.z_m < lowest.z_m) lowest = surface;
    if (!surface.column) planes.add(surface);
    summary.seen = true;
  }
  if (!summary.seen) return summary;
  const float noise_m = 3.0F * std::sqrt(highest.var_m2 + lowest.var_m2);
  summary.stepped = summary.stepped || highest.z_m - lowest.z_m > step_m + noise_m;
  summary.surface = summary.stepped || planes.empty() ? *highest_in_place : planes.mean();
  return summary;
}

}  // namespace floornav
