#include "drivers/bumblebee/rectification.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

/// The largest ideal image of the raw one's size that has no empty border.
constexpr double kNoBorder = 0;

}  // namespace

Rectification::Rectification(const StereoCalibration& calibration) : size_(calibration.left.size) {
  check(calibration);
  const Eye& left = calibration.left;
  const Eye& right = calibration.right;
  cv::Matx33d R_ideal_right;
  cv::Matx34d P_left;
  cv::Matx34d P_right;
  cv::Matx44d reprojection;
  cv::stereoRectify(left.camera, left.distortion, right.camera, right.distortion, size_,
                    calibration.R_right_left, calibration.t_right_left_m, R_ideal_left_, R_ideal_right,
                    P_left, P_right, reprojection, cv::CALIB_ZERO_DISPARITY, kNoBorder, size_);
  cv::initUndistortRectifyMap(left.camera, left.distortion, R_ideal_left_, P_left, size_, CV_16SC2,
                              left_.whole, left_.fraction);
  cv::initUndistortRectifyMap(right.camera, right.distortion, R_ideal_right, P_right, size_, CV_16SC2,
                              right_.whole, right_.fraction);
  camera_.fx = static_cast<float>(P_left(0, 0));
  camera_.fy = static_cast<float>(P_left(1, 1));
  camera_.cx = static_cast<float>(P_left(0, 2));
  camera_.cy = static_cast<float>(P_left(1, 2));
  camera_.width = size_.width;
  camera_.height = size_.height;
  baseline_m_ = -P_right(0, 3) / P_right(0, 0);
}

void Rectification::apply(const cv::Mat& raw_left, const cv::Mat& raw_right, cv::Mat& left,
                          cv::Mat& right) const {
  for (const cv::Mat* image : {&raw_left, &raw_right}) {
    if (image->type() != CV_8UC1) throw std::runtime_error("image is not 8-bit grey");
    if (image->size() != size_)
      throw std::runtime_error(fmt::format("image is {} x {} px, the calibration is for {} x {}", image->cols,
                                           image->rows, size_.width, size_.height));
  }
  cv::remap(raw_left, left, left_.whole, left_.fraction, cv::INTER_LINEAR);
  cv::remap(raw_right, right, right_.whole, right_.fraction, cv::INTER_LINEAR);
}

}  // namespace floornav
