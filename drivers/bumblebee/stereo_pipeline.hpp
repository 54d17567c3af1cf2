#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/rectification.hpp"
#include "drivers/bumblebee/roi_search.hpp"
#include "drivers/bumblebee/stereo_matcher.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Raw pairs in, disparities out: rectifies and matches the rows that matter, in bands.
class StereoPipeline {
 public:
  /// `search`: of each row of the ideal left image. Throws std::runtime_error as StereoMatcher does.
  StereoPipeline(const StereoSettings& settings, Rectification rectification, std::vector<RowSearch> search);

  /// Grey raw images, 8 bit. Throws std::runtime_error for another size.
  void match(const cv::Mat& raw_left, const cv::Mat& raw_right, Parallel& parallel, DisparityImage& image);

  [[nodiscard]] const Rectification& rectification() const { return rectification_; }
  /// From the first row that is matched to the last.
  [[nodiscard]] cv::Range rows() const { return matcher_.rows(); }

 private:
  void rectify(const cv::Mat& raw_left, const cv::Mat& raw_right, Parallel& parallel);

  Rectification rectification_;
  StereoMatcher matcher_;
  cv::Mat left_, right_;
};

}  // namespace floornav
