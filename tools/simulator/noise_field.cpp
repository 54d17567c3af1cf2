#include "tools/simulator/noise_field.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "tools/simulator/random.hpp"

namespace floornav {

NoiseField::NoiseField(int width, int height, int correlation_px)
    : width_(width),
      height_(height),
      window_(std::max(1, correlation_px)),
      field_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      white_row_(static_cast<std::size_t>(width + window_ - 1)),
      row_sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(window_)),
      column_sum_(static_cast<std::size_t>(width)) {}

const std::vector<float>& NoiseField::draw(std::uint64_t key) {
  const auto columns = static_cast<std::size_t>(width_);
  const auto window = static_cast<std::size_t>(window_);
  if (window_ == 1) {
    for (std::size_t v = 0; v < static_cast<std::size_t>(height_); ++v)
      fill_normals(random_key({key, v}), std::span(field_).subspan(v * columns, columns));
    return field_;
  }
  const float scale = 1.0F / static_cast<float>(window_);
  std::ranges::fill(row_sums_, 0.0F);
  std::ranges::fill(column_sum_, 0.0F);
  for (std::size_t v = 0; v + 1 < static_cast<std::size_t>(height_) + window; ++v) {
    fill_normals(random_key({key, v}), white_row_);
    float* sums = row_sums_.data() + (v % window) * columns;
    float sum = 0;
    for (std::size_t i = 0; i + 1 < window; ++i) sum += white_row_[i];
    for (std::size_t u = 0; u < columns; ++u) {
      sum += white_row_[u + window - 1];
      column_sum_[u] += sum - sums[u];
      sums[u] = sum;
      sum -= white_row_[u];
    }
    if (v + 1 < window) continue;
    float* out = field_.data() + (v + 1 - window) * columns;
    for (std::size_t u = 0; u < columns; ++u) out[u] = scale * column_sum_[u];
  }
  return field_;
}

}  // namespace floornav
