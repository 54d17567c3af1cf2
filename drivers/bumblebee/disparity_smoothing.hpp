#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace floornav {

/// Each disparity becomes the mean of those around it that belong to the same surface: a window warped by
/// smooth disparities follows a slanted floor, one warped by noisy ones keeps their noise.
class DisparitySmoothing {
 public:
  /// `window`: side, px, odd.
  explicit DisparitySmoothing(int window) : reach_(window / 2 / kStride * kStride) {}

  /// Some rows of `rough` to the same ones of `smooth`, an image of the same size; 0 stays 0. Bands of rows
  /// are independent work, each with its own object.
  void apply(const cv::Mat1f& rough, cv::Range rows, cv::Mat1f& smooth);

 private:
  static constexpr int kStride = 2;  ///< every other neighbour is enough
  int reach_;
  std::vector<float> counts_;
};

}  // namespace floornav
