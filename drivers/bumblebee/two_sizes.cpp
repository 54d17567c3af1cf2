#include "drivers/bumblebee/two_sizes.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

inline float between(float nearest, float beside, float below, float across) {
  constexpr float kSameSurface_px = 1.0F;
  const float least = std::min(std::min(beside, below), across);
  const float most = std::max(std::max(beside, below), across);
  const bool same = (least > 0) & (most - nearest < kSameSurface_px) & (nearest - least < kSameSurface_px);
  const float mixed = 0.5625F * nearest + 0.1875F * (beside + below) + 0.0625F * across;
  return same ? mixed : nearest;
}

/// One row at twice its length; `other` is the small row on the new row's far side.
void enlarge_row(const float* row, const float* other, int columns, float* to) {
  for (int x = 1; x + 1 < columns; ++x) {
    to[2 * x] = 2 * between(row[x], row[x - 1], other[x], other[x - 1]);
    to[2 * x + 1] = 2 * between(row[x], row[x + 1], other[x], other[x + 1]);
  }
  for (const int x : {0, columns - 1}) to[2 * x] = to[2 * x + 1] = 2 * row[x];
}

}  // namespace

void halve(const cv::Mat1b& whole, cv::Range rows, cv::Mat1b& half) {
  cv::Mat part = half.rowRange(rows);
  cv::resize(whole({2 * rows.start, 2 * rows.end}, {0, 2 * half.cols}), part, part.size(), 0, 0,
             cv::INTER_AREA);
}

void enlarge(const cv::Mat1f& half, cv::Range rows, cv::Mat1f& whole) {
  for (int y = rows.start; y < rows.end; ++y) {
    const int row = std::min(y / 2, half.rows - 1);
    const int other = std::clamp((y & 1) != 0 ? row + 1 : row - 1, 0, half.rows - 1);
    enlarge_row(half[row], half[other], half.cols, whole[y]);
    if (2 * half.cols < whole.cols) whole(y, whole.cols - 1) = 0;
  }
}

}  // namespace floornav
