#include "perception/cell_rise.hpp"

#include <algorithm>

#include "perception/noise_correlation.hpp"

namespace floornav {

namespace {

float drawn_to_zero(float value, float variance, float sigmas) {
  const float squared = value * value;
  if (squared <= 0.0F) return 0.0F;
  return value * std::max(0.0F, 1.0F - sigmas * sigmas * variance / squared);
}

/// The sum over the cells of one group up to `reach` columns and rows away.
CellRise around(const std::vector<CellRise>& rises, const CellWindow& window, std::int32_t number,
                std::int32_t reach) {
  const std::int16_t group = rises[static_cast<std::size_t>(number)].group;
  const std::int32_t x = number % window.size_x(), y = number / window.size_x();
  CellRise sum;
  for (std::int32_t v = std::max(0, y - reach); v <= std::min(window.size_y() - 1, y + reach); ++v)
    for (std::int32_t u = std::max(0, x - reach); u <= std::min(window.size_x() - 1, x + reach); ++u) {
      const CellRise& rise = rises[static_cast<std::size_t>(v * window.size_x() + u)];
      if (rise.group == group) sum += rise;
    }
  return sum;
}

}  // namespace

float significant_rise(const std::vector<CellRise>& rises, const CellWindow& window, std::int32_t number,
                       float significance_sigmas, const CellNoise& noise) {
  float significant = 0.0F;
  float coarser = 0.0F;
  for (const std::int32_t reach : {2, 1, 0}) {
    const CellRise sum = around(rises, window, number, reach);
    const float width_px = static_cast<float>(2 * reach + 1) * noise.width_px;
    const float variance = sum.variance_m2(independent_measurements(sum.points, width_px, noise.alike_px));
    significant += drawn_to_zero(sum.mean_m() - coarser, variance, significance_sigmas);
    coarser = sum.mean_m();
  }
  return significant;
}

}  // namespace floornav
