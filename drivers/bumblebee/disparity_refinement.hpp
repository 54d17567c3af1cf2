#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace floornav {

/// Refines disparities that are within about a pixel of the truth, at full resolution.
///
/// Around each pixel a window of the right image, warped by the disparities there (so that it follows a
/// slanted floor; disparities of one surface are smoothed first), is compared with the left one; the shift
/// that is left over is found by least squares on the images' gradients (Lucas-Kanade), brightness difference
/// taken out, again `kRounds` times. Being no parabola through whole disparities it does not prefer whole
/// ones.
class DisparityRefinement {
 public:
  static constexpr int kRounds = 2;
  /// `window`: side, px, odd.
  explicit DisparityRefinement(int window) : window_(window) {}

  /// `left`, `right`: rectified, CV_32F. `disparity` (px; 0 = none) is refined in place. `sigma` becomes 1
  /// sigma of each, px, from what is left of the difference and from the window's texture; infinite where the
  /// window has none or the rounds did not settle.
  void refine(const cv::Mat1f& left, const cv::Mat1f& right, cv::Mat1f& disparity, cv::Mat1f& sigma);

 private:
  void smooth(cv::Mat1f& disparity);
  void compare(const cv::Mat1f& left, const cv::Mat1f& right, const cv::Mat1f& disparity);
  void sum_windows();

  int window_;
  cv::Mat1f rough_;  ///< disparities before smoothing
  std::vector<float> counts_;
  cv::Mat1f known_;     ///< 1 where a disparity is
  cv::Mat1f rest_;      ///< left minus warped right
  cv::Mat1f gradient_;  ///< along the row, mean of both images
  cv::Mat1f product_;   ///< gradient x rest
  cv::Mat1f squares_;   ///< gradient squared
  cv::Mat1f rest_squares_;
};

}  // namespace floornav
