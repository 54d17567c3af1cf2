#include "perception/lower_border.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

namespace {

constexpr float kPartOfThreshold = 0.7F;
constexpr float kLeastLeft = 0.4F;          ///< of the points
constexpr float kLeastThreshold_m = 0.03F;  ///< in depth: what is nearer is not tilted to speak of

}  // namespace

void LowerBorder::leave_out(const PlanePool& pool, const RoiCloud& cloud, const Pinhole& camera,
                            const InverseDepthPlane& plane, float threshold_sigmas,
                            std::span<float> weights) {
  const auto pixel_of = [&](std::size_t i) { return cloud.pixel[static_cast<std::size_t>(pool.point[i])]; };
  last_row_.assign(static_cast<std::size_t>(camera.width), -1);
  float certainty = 0.0F, inverse_depth = 0.0F, points = 0.0F;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    if (weights[i] == 0.0F) continue;
    const std::int32_t pixel = pixel_of(i);
    std::int32_t& last = last_row_[static_cast<std::size_t>(pixel % camera.width)];
    last = std::max(last, pixel / camera.width);
    certainty += pool.certainty[i];
    inverse_depth += pool.inverse_depth[i];
    points += 1.0F;
  }
  if (points == 0.0F) return;
  const float inverse_depth_a_row = std::abs(plane.b) / camera.fy;
  const float threshold = threshold_sigmas * points / certainty;  // 1/m
  inverse_depth /= points;
  if (threshold < kLeastThreshold_m * inverse_depth * inverse_depth) return;
  const float off = kPartOfThreshold * threshold;
  if (!(off < static_cast<float>(camera.height) * inverse_depth_a_row)) return;
  const auto rows = static_cast<std::int32_t>(std::ceil(off / inverse_depth_a_row));
  float left = 0.0F;
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (weights[i] != 0.0F && !is_next_to(pixel_of(i), camera.width, rows)) left += 1.0F;
  if (left < kLeastLeft * points) return;
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (weights[i] != 0.0F && is_next_to(pixel_of(i), camera.width, rows)) weights[i] = 0.0F;
}

}  // namespace floornav
