#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/refinement_kernel.hpp"

namespace floornav {

/// One round of refining disparities that are within about a pixel of the truth.
///
/// Around each pixel a window of the right image, warped by the disparities there, is compared with the left
/// one; the shift that is left over is found by least squares on the images' gradients (Lucas-Kanade),
/// brightness difference taken out. Being no parabola through whole disparities it does not prefer whole
/// ones.
class DisparityRefinement {
 public:
  /// `window`: px, odd.
  explicit DisparityRefinement(cv::Size window) : reach_(window / 2) {}

  /// Some rows: `left` and `right` rectified, 8 bit; `disparity` px, 0 = none, to `refined`. `sigma` becomes
  /// 1 sigma of each, px, from what is left of the difference and from the window's texture; infinite where
  /// the window has none or the disparity has not settled. Bands of rows are independent work, each with its
  /// own object.
  void refine(const cv::Mat1b& left, const cv::Mat1b& right, const cv::Mat1f& disparity, cv::Range rows,
              cv::Mat1f& refined, cv::Mat1f& sigma);

 private:
  void begin(int columns);

  cv::Size reach_;                 ///< half of the window
  std::vector<ComparedRow> ring_;  ///< the rows that are in the sums, and one that comes
  ColumnSums sums_;
  std::vector<std::int32_t> packed_;
};

}  // namespace floornav
