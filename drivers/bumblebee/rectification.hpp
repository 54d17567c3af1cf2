#pragma once

#include <functional>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/stereo_calibration.hpp"
#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// Turns a pair of raw images into those of two ideal cameras of equal intrinsics side by side: a point is
/// seen in the same row of both, in the left one `fx baseline / Z` columns farther right.
class Rectification {
 public:
  /// Where a place of an ideal image is in the raw one, px.
  using RawPlace = std::function<cv::Point2d(cv::Point2d)>;

  /// `shrink` 2: ideal images of half the raw ones' width and height. Throws std::runtime_error for a
  /// calibration that check() refuses.
  explicit Rectification(const StereoCalibration& calibration, int shrink = 1);
  /// Of raw images as large as `ideal`, by a warp of each eye.
  Rectification(const Pinhole& ideal, double baseline_m, const RawPlace& left, const RawPlace& right,
                int shrink = 1);

  /// Images of the calibration's size, 8 bit, one channel. Throws std::runtime_error for others.
  void apply(const cv::Mat& raw_left, const cv::Mat& raw_right, cv::Mat& left, cv::Mat& right) const;
  /// The same for some of the ideal rows, in images that prepare() has made: bands are independent work.
  void apply_rows(const cv::Mat& raw_left, const cv::Mat& raw_right, cv::Range rows, cv::Mat& left,
                  cv::Mat& right) const;
  /// Checks the raw images as apply() does and makes the ideal ones, rows yet to be filled.
  void prepare(const cv::Mat& raw_left, const cv::Mat& raw_right, cv::Mat& left, cv::Mat& right) const;

  /// The ideal left camera.
  [[nodiscard]] const Pinhole& camera() const { return camera_; }
  [[nodiscard]] double baseline_m() const { return baseline_m_; }
  /// The ideal left camera, turned a little against the real one.
  [[nodiscard]] Pose T_left_ideal() const;
  /// Rotates axes of the real left camera into those of the ideal one.
  [[nodiscard]] const cv::Matx33d& R_ideal_left() const { return R_ideal_left_; }

 private:
  struct Table {
    cv::Mat whole;     ///< where each ideal pixel comes from: whole pixels
    cv::Mat fraction;  ///< and 1/32
  };
  cv::Size size_;  ///< of raw images
  Table left_;
  Table right_;
  Pinhole camera_;
  double baseline_m_ = 0;
  cv::Matx33d R_ideal_left_ = cv::Matx33d::eye();
};

}  // namespace floornav
