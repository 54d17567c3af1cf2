#include "drivers/bumblebee/disparity_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace floornav {
namespace {

/// Adds to each pixel of a row those of another row, `shift` columns on, that lie on the same surface.
void add_same_surface(const float* center, const float* other, int shift, int columns, float* sum,
                      float* count) {
  constexpr float kSameSurface_px = 1.0F;
  const int first = std::max(0, -shift);
  const int end = std::min(columns, columns - shift);
  for (int x = first; x < end; ++x) {
    const float value = other[x + shift];
    const float same = (value > 0) & (std::abs(value - center[x]) < kSameSurface_px) ? 1.0F : 0.0F;
    sum[x] += same * value;
    count[x] += same;
  }
}

}  // namespace

void DisparitySmoothing::apply(const cv::Mat1f& rough, cv::Range rows, cv::Mat1f& smooth) {
  const int columns = rough.cols;
  for (int y = rows.start; y < rows.end; ++y) {
    float* const sum = smooth[y];
    std::fill_n(sum, columns, 0.0F);
    counts_.assign(static_cast<std::size_t>(columns), 0.0F);
    for (int dy = -reach_; dy <= reach_; dy += kStride) {
      if (y + dy < 0 || y + dy >= rough.rows) continue;
      for (int dx = -reach_; dx <= reach_; dx += kStride)
        add_same_surface(rough[y], rough[y + dy], dx, columns, sum, counts_.data());
    }
    const float* const center = rough[y];
    for (int x = 0; x < columns; ++x)
      sum[x] = center[x] > 0 ? sum[x] / std::max(1.0F, counts_[static_cast<std::size_t>(x)]) : 0.0F;
  }
}

}  // namespace floornav
