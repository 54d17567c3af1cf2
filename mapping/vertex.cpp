#include "mapping/vertex.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floornav {
namespace {

/// From the centre of a cell to that of the square.
struct WayToCenter {
  float x_m = 0, y_m = 0;
};

WayToCenter way_from(std::size_t index, std::int32_t side, float pitch_m) {
  const float half = 0.5F * static_cast<float>(side - 1);
  return {(half - static_cast<float>(static_cast<std::int32_t>(index) % side)) * pitch_m,
          (half - static_cast<float>(static_cast<std::int32_t>(index) / side)) * pitch_m};
}

/// How much higher a surface is that way on.
float rise_m(const Surface& surface, const WayToCenter& way) {
  const float rise = std::hypot(surface.gradient_x, surface.gradient_y);
  if (surface.column || rise > Surface::kSteepestCarried) return 0.0F;
  return surface.gradient_x * way.x_m + surface.gradient_y * way.y_m;
}

/// The mean of surfaces, weighted by the inverse of their variances. Columns have no gradient.
class MeanSurface {
 public:
  void add(const Surface& surface, const WayToCenter& way) {
    const double weight = 1.0 / static_cast<double>(surface.var_m2);
    weight_ += weight;
    z_ += weight * static_cast<double>(surface.z_m);
    way_x_ += weight * static_cast<double>(way.x_m);
    way_y_ += weight * static_cast<double>(way.y_m);
    if (surface.column) return;
    plane_weight_ += weight;
    gradient_x_ += weight * static_cast<double>(surface.gradient_x);
    gradient_y_ += weight * static_cast<double>(surface.gradient_y);
  }
  [[nodiscard]] bool has_planes() const { return plane_weight_ > 0; }
  /// At the mean of the surfaces' places.
  [[nodiscard]] float z_m() const { return static_cast<float>(z_ / weight_); }
  [[nodiscard]] float var_m2() const { return static_cast<float>(1.0 / weight_); }
  /// Carried on to the square's centre; only where there are planes.
  [[nodiscard]] Surface at_center() const {
    Surface mean{.z_m = z_m(),
                 .var_m2 = var_m2(),
                 .gradient_x = static_cast<float>(gradient_x_ / plane_weight_),
                 .gradient_y = static_cast<float>(gradient_y_ / plane_weight_)};
    mean.z_m += rise_m(mean, {static_cast<float>(way_x_ / weight_), static_cast<float>(way_y_ / weight_)});
    return mean;
  }

 private:
  double weight_ = 0, plane_weight_ = 0;
  double z_ = 0, way_x_ = 0, way_y_ = 0;
  double gradient_x_ = 0, gradient_y_ = 0;
};

/// The highest surface, with the height of its highest place that was seen: the mean of those that differ
/// from it by no more than their noise and half a step, since the highest of many heights alone is too high
/// by their noise.
Surface highest_of(std::span<const CellMemory> cells, float pitch_m, float step_m) {
  Surface highest;
  bool found = false;
  for (const CellMemory& cell : cells) {
    const Surface* const surface = cell.decider();
    if (surface == nullptr || (found && surface->z_m + surface->reach_m(pitch_m) <= highest.z_m)) continue;
    highest = *surface;
    highest.z_m = surface->z_m + surface->reach_m(pitch_m);
    found = true;
  }
  MeanSurface alike;
  for (const CellMemory& cell : cells) {
    const Surface* const surface = cell.decider();
    if (surface == nullptr) continue;
    const float noise_m = 3.0F * std::sqrt(surface->var_m2 + highest.var_m2);
    Surface top = *surface;
    top.z_m = surface->z_m + surface->reach_m(pitch_m);
    if (highest.z_m - top.z_m < std::min(noise_m, 0.5F * step_m)) alike.add(top, {});
  }
  Surface result = highest;
  result.z_m = alike.z_m();
  result.var_m2 = alike.var_m2();
  return result;
}

}  // namespace

float slope_deg(const Surface& surface) {
  return std::atan(std::hypot(surface.gradient_x, surface.gradient_y)) * (180.0F / std::numbers::pi_v<float>);
}

SquareSummary summarise(std::span<const CellMemory> cells, std::int32_t side, float pitch_m, float step_m) {
  SquareSummary summary;
  MeanSurface mean;
  const Surface* highest = nullptr;
  float highest_z_m = 0, lowest_z_m = 0, lowest_var_m2 = 0;  // at the centre
  float most_z_m = 0;                                        // of all places that were seen
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Surface* const surface = cells[i].decider();
    if (surface == nullptr) continue;
    summary.stepped = summary.stepped || cells[i].is_stepped(step_m);
    const WayToCenter way = way_from(i, side, pitch_m);
    const float z_m = surface->z_m + rise_m(*surface, way);
    if (!summary.seen || z_m < lowest_z_m) {
      lowest_z_m = z_m;
      lowest_var_m2 = surface->var_m2;
    }
    if (!summary.seen || z_m > highest_z_m) {
      highest_z_m = z_m;
      highest = surface;
    }
    most_z_m = summary.seen ? std::max(most_z_m, surface->z_m + surface->reach_m(pitch_m))
                            : surface->z_m + surface->reach_m(pitch_m);
    mean.add(*surface, way);
    summary.seen = true;
  }
  if (!summary.seen) return summary;
  const float noise_m = 3.0F * std::sqrt(highest->var_m2 + lowest_var_m2);
  summary.stepped = summary.stepped || highest_z_m - lowest_z_m > step_m + noise_m;
  summary.surface =
      summary.stepped || !mean.has_planes() ? highest_of(cells, pitch_m, step_m) : mean.at_center();
  summary.surface.z_m = std::min(summary.surface.z_m, most_z_m);
  summary.surface.reach = 0;
  return summary;
}

}  // namespace floornav
