#include "drivers/bumblebee/disparity_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

/// Value and rise at a place of a row, by the cubic through four pixels (Catmull-Rom).
struct Sample {
  float value;
  float rise;
};

Sample sample(const float* row, float at) {
  const auto whole = static_cast<int>(at);
  const float t = at - static_cast<float>(whole);
  const float a = row[whole - 1];
  const float b = row[whole];
  const float c = row[whole + 1];
  const float d = row[whole + 2];
  const float k1 = 0.5F * (c - a);
  const float k2 = a - 2.5F * b + 2 * c - 0.5F * d;
  const float k3 = 0.5F * (d - a) + 1.5F * (b - c);
  return {b + t * (k1 + t * (k2 + t * k3)), k1 + t * (2 * k2 + t * 3 * k3)};
}

/// Adds to each pixel of a row those of another row, `shift` columns on, that lie on the same surface.
void add_same_surface(const float* center, const float* other, int shift, int columns, float* sum,
                      float* count) {
  constexpr float kSameSurface_px = 1.0F;
  const int first = std::max(0, -shift);
  const int end = std::min(columns, columns - shift);
  for (int x = first; x < end; ++x) {
    const float value = other[x + shift];
    const bool same = value > 0 && std::abs(value - center[x]) < kSameSurface_px;
    sum[x] += same ? value : 0.0F;
    count[x] += same ? 1.0F : 0.0F;
  }
}

}  // namespace

/// Each disparity becomes the mean of those around it that belong to the same surface.
void DisparityRefinement::smooth(cv::Mat1f& disparity) {
  constexpr int kStride = 2;
  const int reach = window_ / 2 / kStride * kStride;
  const int columns = disparity.cols;
  disparity.copyTo(rough_);
  std::vector<float>& count = counts_;
  for (int y = 0; y < disparity.rows; ++y) {
    float* const sum = disparity[y];
    std::fill_n(sum, columns, 0.0F);
    count.assign(static_cast<std::size_t>(columns), 0.0F);
    for (int dy = std::max(-reach, -y / kStride * kStride); dy <= reach && y + dy < disparity.rows;
         dy += kStride)
      for (int dx = -reach; dx <= reach; dx += kStride)
        add_same_surface(rough_[y], rough_[y + dy], dx, columns, sum, count.data());
    for (int x = 0; x < columns; ++x)
      sum[x] = rough_(y, x) > 0 ? sum[x] / count[static_cast<std::size_t>(x)] : 0.0F;
  }
}

void DisparityRefinement::compare(const cv::Mat1f& left, const cv::Mat1f& right, const cv::Mat1f& disparity) {
  known_.create(left.size());
  rest_.create(left.size());
  gradient_.create(left.size());
  for (int y = 0; y < left.rows; ++y) {
    const float* const from = left[y];
    const float* const other = right[y];
    const float* const shift = disparity[y];
    for (int x = 0; x < left.cols; ++x) {
      const float at = static_cast<float>(x) - shift[x];
      const bool known =
          shift[x] > 0 && at >= 1 && at < static_cast<float>(left.cols - 3) && x > 0 && x + 1 < left.cols;
      known_(y, x) = known ? 1.0F : 0.0F;
      if (!known) {
        rest_(y, x) = gradient_(y, x) = 0;
        continue;
      }
      const Sample seen = sample(other, at);
      rest_(y, x) = from[x] - seen.value;
      gradient_(y, x) = 0.5F * (0.5F * (from[x + 1] - from[x - 1]) + seen.rise);
    }
  }
}

void DisparityRefinement::sum_windows() {
  cv::multiply(gradient_, rest_, product_);
  cv::multiply(gradient_, gradient_, squares_);
  cv::multiply(rest_, rest_, rest_squares_);
  for (cv::Mat1f* sum : {&known_, &rest_, &gradient_, &product_, &squares_, &rest_squares_})
    cv::boxFilter(*sum, *sum, -1, {window_, window_}, {-1, -1}, false, cv::BORDER_CONSTANT);
}

void DisparityRefinement::refine(const cv::Mat1f& left, const cv::Mat1f& right, cv::Mat1f& disparity,
                                 cv::Mat1f& sigma) {
  constexpr float kMostStep_px = 1.0F;
  constexpr float kSettled_px = 0.25F;
  constexpr float kModel_px = 0.05F;     // 1 sigma of what interpolation and the window's shape add
  constexpr float kLeastTexture = 4.0F;  // mean square of the gradient, grey levels a pixel
  sigma.create(disparity.size());
  for (int round = 0; round < kRounds; ++round) {
    smooth(disparity);
    compare(left, right, disparity);
    sum_windows();
    for (int y = 0; y < disparity.rows; ++y) {
      for (int x = 0; x < disparity.cols; ++x) {
        const float n = known_(y, x);
        sigma(y, x) = std::numeric_limits<float>::infinity();
        if (disparity(y, x) <= 0 || n < 1) continue;
        const float texture = squares_(y, x) - gradient_(y, x) * gradient_(y, x) / n;
        if (texture < kLeastTexture * n) continue;
        const float step = -(product_(y, x) - gradient_(y, x) * rest_(y, x) / n) / texture;
        disparity(y, x) = std::max(0.0F, disparity(y, x) + std::clamp(step, -kMostStep_px, kMostStep_px));
        const float rest = std::max(0.0F, rest_squares_(y, x) - rest_(y, x) * rest_(y, x) / n);
        if (std::abs(step) < kSettled_px) sigma(y, x) = std::sqrt(rest / n / texture + kModel_px * kModel_px);
      }
    }
  }
}

}  // namespace floornav
