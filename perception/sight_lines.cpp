#include "perception/sight_lines.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "perception/row_bands.hpp"

namespace floornav {

namespace {

constexpr float kEndMargin_sigmas = 3.0F;
/// Of the bins, in pitches, so that few cells under a ray are stepped over.
constexpr double kStepPerPitch = 0.7;
constexpr double kDirectionPerPitch = 0.35;
constexpr float kTurn = 4.0F;  ///< once around in the measure of direction_of

/// Direction of the compass: grows with the angle, 4 once around, but needs no arc tangent.
float direction_of(float x, float y) {
  const float along = y / (std::abs(x) + std::abs(y));
  return x >= 0.0F ? along + 1.0F : 3.0F - along;
}

/// The inverse, a unit vector.
Eigen::Vector2f toward(float direction) {
  const float along = direction <= 2.0F ? direction - 1.0F : 3.0F - direction;
  const float x = direction <= 2.0F ? 1.0F - std::abs(along) : std::abs(along) - 1.0F;
  return Eigen::Vector2f(x, along).normalized();
}

}  // namespace

SightLineTracer::SightLineTracer(const RoiSettings& roi, const CellSettings& cells)
    : roi_(roi),
      pitch_m_(cells.pitch_m),
      stride_px_(cells.sight_line_stride_px),
      step_m_(static_cast<float>(kStepPerPitch * cells.pitch_m)) {
  const double reach_m = std::hypot(std::max(std::abs(roi.x_min_m), std::abs(roi.x_max_m)),
                                    std::max(std::abs(roi.y_min_m), std::abs(roi.y_max_m)));
  directions_ = static_cast<std::size_t>(
      std::ceil(static_cast<double>(kTurn) * reach_m / (kDirectionPerPitch * cells.pitch_m)));
  distances_ = static_cast<std::size_t>(std::ceil(reach_m / static_cast<double>(step_m_))) + 1;
}

void SightLineTracer::trace(const MeasuredImage& image, const SensorView& view, const CellWindow& window,
                            Parallel& parallel, std::vector<float>& lowest_z_m) {
  fans_.resize(static_cast<std::size_t>(parallel.workers()));
  for (Fan& fan : fans_) {
    fan.slope.resize(directions_ * distances_);
    fan.is_hit.assign(directions_, 0);
  }
  const RowBands rows{image.height};
  const auto follow = [&](int band, int worker) {
    for (int row = rows.first(band); row < rows.end(band); row += stride_px_)
      follow_row(image, view, row, fans_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(rows.count(), std::ref(follow));
  lowest_z_m.assign(static_cast<std::size_t>(window.count()), kNone);
  for (std::size_t direction = 0; direction < directions_; ++direction)
    lower_cells(direction, view, window, lowest_z_m);
}

/// Notes the ends of a sample of the row's rays, a margin before what they met.
void SightLineTracer::follow_row(const MeasuredImage& image, const SensorView& view, int row,
                                 Fan& fan) const {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  const auto sensor_z = static_cast<float>(view.T_world_sensor.translation().z());
  const auto top_z = static_cast<float>(view.T_world_body.translation().z() + roi_.z_max_m);
  const auto pitch_m = static_cast<float>(pitch_m_);
  const std::size_t first = image.row_begin(row);
  for (int column = 0; column < image.width; column += stride_px_) {
    const float inverse_depth = image.inverse_depth[first + static_cast<std::size_t>(column)];
    if (!(inverse_depth > 0.0F)) continue;
    const Eigen::Vector3f ray = R * view.camera.ray(static_cast<float>(column), static_cast<float>(row));
    const float per_depth = std::max(ray.head<2>().norm(), 1e-3F);
    const float slope = ray.z() / per_depth;
    const float depth = 1.0F / inverse_depth;
    const float sigma = depth * depth / image.certainty[first + static_cast<std::size_t>(column)];
    float end_m = (depth - kEndMargin_sigmas * sigma) * per_depth - pitch_m;
    if (slope > 0.0F) end_m = std::min(end_m, (top_z - sensor_z) / slope);
    if (!(end_m > 0.0F)) continue;
    const auto distance = std::min(static_cast<std::size_t>(end_m / step_m_), distances_ - 1);
    const auto direction = std::min(
        static_cast<std::size_t>(direction_of(ray.x(), ray.y()) / kTurn * static_cast<float>(directions_)),
        directions_ - 1);
    float* const slopes = fan.slope.data() + direction * distances_;
    if (!std::exchange(fan.is_hit[direction], std::uint8_t{1})) std::fill_n(slopes, distances_, kNone);
    slopes[distance] = std::min(slopes[distance], slope);
  }
}

/// Walks in one direction from far to near with the steepest ray that ended farther off.
void SightLineTracer::lower_cells(std::size_t direction, const SensorView& view, const CellWindow& window,
                                  std::vector<float>& lowest_z_m) {
  if (std::none_of(fans_.begin(), fans_.end(), [&](const Fan& fan) { return fan.is_hit[direction] != 0; }))
    return;
  const Eigen::Vector2f begin = window.pitches_of(view.T_world_sensor.translation()).cast<float>();
  const Eigen::Vector2f way =
      step_m_ / static_cast<float>(pitch_m_) *
      toward((static_cast<float>(direction) + 0.5F) * kTurn / static_cast<float>(directions_));
  const auto sensor_z = static_cast<float>(view.T_world_sensor.translation().z());
  const auto top_z = static_cast<float>(view.T_world_body.translation().z() + roi_.z_max_m);
  float steepest = kNone;
  for (std::size_t k = distances_; k-- > 0;) {
    for (const Fan& fan : fans_)
      if (fan.is_hit[direction]) steepest = std::min(steepest, fan.slope[direction * distances_ + k]);
    const auto steps = static_cast<float>(k);
    const float z = sensor_z + steepest * steps * step_m_;
    if (!(z <= top_z)) continue;
    const std::int32_t cell = window.at_pitches(begin.x() + steps * way.x(), begin.y() + steps * way.y());
    if (cell < 0) continue;
    float& lowest = lowest_z_m[static_cast<std::size_t>(cell)];
    lowest = std::min(lowest, z);
  }
}

}  // namespace floornav
