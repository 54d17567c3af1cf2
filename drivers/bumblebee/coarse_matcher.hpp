#pragma once

#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "drivers/bumblebee/roi_search.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Disparities to about a pixel by OpenCV's matchers, in bands of rows, each searched for what it can show.
class CoarseMatcher {
 public:
  /// How the images are matched.
  struct Method {
    bool block = false;    ///< StereoBM instead of SGBM
    int shrink = 1;        ///< on images so many times smaller
    int speckle_px = 200;  ///< smaller patches of disparity are left out, px of the whole images
  };

  /// `search`: of each row of the whole images. Throws std::runtime_error where it asks for more disparities
  /// than the image is wide.
  CoarseMatcher(const Method& method, cv::Size size, const std::vector<RowSearch>& search);

  /// Rectified images `shrink` times smaller than the whole ones, 8-bit grey, of which only seen_rows() are
  /// looked at. `disparity` becomes as large as they: px of theirs; 0: none.
  void match(const cv::Mat1b& left, const cv::Mat1b& right, Parallel& parallel, cv::Mat1f& disparity);

  /// From the first row that is searched to the last; of the whole images.
  [[nodiscard]] cv::Range rows() const;
  /// Those and the ones around them that help.
  [[nodiscard]] cv::Range seen_rows() const;

 private:
  /// Rows that are matched together; of the smaller images.
  struct Band {
    cv::Range rows;
    cv::Range seen;  ///< with those around
    int least = 0;   ///< disparity
    int count = 16;  ///< of disparities
    cv::Ptr<cv::StereoMatcher> matcher;
    cv::Mat left, right, found;
  };

  void add_band(cv::Range rows, const RowSearch& search);
  void match_band(const cv::Mat1b& left, const cv::Mat1b& right, Band& band);

  Method method_;
  cv::Size size_;  ///< of the smaller images
  std::vector<Band> bands_;
  cv::Mat_<short> found_;  ///< 1/16 px
};

}  // namespace floornav
