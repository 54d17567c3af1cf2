#include "drivers/bumblebee/rectification.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

/// The largest ideal image of the raw one's size that has no empty border.
constexpr double kNoBorder = 0;

/// The camera whose pixels are squares of `shrink` x `shrink` of this one's.
Pinhole shrunk(const Pinhole& camera, int shrink) {
  const auto n = static_cast<float>(shrink);
  return {camera.fx / n,
          camera.fy / n,
          (camera.cx + 0.5F) / n - 0.5F,
          (camera.cy + 0.5F) / n - 0.5F,
          camera.width / shrink,
          camera.height / shrink};
}

cv::Matx33d matrix_of(const Pinhole& camera) {
  return {static_cast<double>(camera.fx),
          0,
          static_cast<double>(camera.cx),
          0,
          static_cast<double>(camera.fy),
          static_cast<double>(camera.cy),
          0,
          0,
          1};
}

/// Places in the ideal image of the unshrunk size that a shrunk one's pixel stands for: its square's middle.
cv::Mat2f places_of(const Pinhole& ideal, int shrink, const Rectification::RawPlace& raw) {
  const Pinhole camera = shrunk(ideal, shrink);
  cv::Mat2f places(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const cv::Point2d at((x + 0.5) * shrink - 0.5, (y + 0.5) * shrink - 0.5);
      const cv::Point2d to = raw(at);
      places(y, x) = {static_cast<float>(to.x), static_cast<float>(to.y)};
    }
  return places;
}

}  // namespace

Rectification::Rectification(const StereoCalibration& calibration, int shrink)
    : size_(calibration.left.size) {
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
  const Pinhole ideal{static_cast<float>(P_left(0, 0)),
                      static_cast<float>(P_left(1, 1)),
                      static_cast<float>(P_left(0, 2)),
                      static_cast<float>(P_left(1, 2)),
                      size_.width,
                      size_.height};
  camera_ = shrunk(ideal, shrink);
  baseline_m_ = -P_right(0, 3) / P_right(0, 0);
  const cv::Size to(camera_.width, camera_.height);
  const cv::Matx33d K = matrix_of(camera_);
  cv::initUndistortRectifyMap(left.camera, left.distortion, R_ideal_left_, K, to, CV_16SC2, left_.whole,
                              left_.fraction);
  cv::initUndistortRectifyMap(right.camera, right.distortion, R_ideal_right, K, to, CV_16SC2, right_.whole,
                              right_.fraction);
}

Rectification::Rectification(const Pinhole& ideal, double baseline_m, const RawPlace& left,
                             const RawPlace& right, int shrink)
    : size_(ideal.width, ideal.height), camera_(shrunk(ideal, shrink)), baseline_m_(baseline_m) {
  cv::convertMaps(places_of(ideal, shrink, left), {}, left_.whole, left_.fraction, CV_16SC2);
  cv::convertMaps(places_of(ideal, shrink, right), {}, right_.whole, right_.fraction, CV_16SC2);
}

Pose Rectification::T_left_ideal() const {
  Pose T = Pose::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) T.linear()(row, column) = R_ideal_left_(column, row);
  return T;
}

void Rectification::prepare(const cv::Mat& raw_left, const cv::Mat& raw_right, cv::Mat& left,
                            cv::Mat& right) const {
  for (const cv::Mat* image : {&raw_left, &raw_right}) {
    if (image->type() != CV_8UC1) throw std::runtime_error("image is not 8-bit grey");
    if (image->size() != size_)
      throw std::runtime_error(fmt::format("image is {} x {} px, the calibration is for {} x {}", image->cols,
                                           image->rows, size_.width, size_.height));
  }
  left.create(camera_.height, camera_.width, CV_8UC1);
  right.create(camera_.height, camera_.width, CV_8UC1);
}

void Rectification::apply(const cv::Mat& raw_left, const cv::Mat& raw_right, cv::Mat& left,
                          cv::Mat& right) const {
  prepare(raw_left, raw_right, left, right);
  apply_rows(raw_left, raw_right, cv::Range(0, camera_.height), left, right);
}

void Rectification::apply_rows(const cv::Mat& raw_left, const cv::Mat& raw_right, cv::Range rows,
                               cv::Mat& left, cv::Mat& right) const {
  const auto fill = [rows](const cv::Mat& raw, const Table& table, cv::Mat& ideal) {
    cv::Mat part = ideal.rowRange(rows);
    cv::remap(raw, part, table.whole.rowRange(rows), table.fraction.rowRange(rows), cv::INTER_LINEAR);
  };
  fill(raw_left, left_, left);
  fill(raw_right, right_, right);
}

}  // namespace floornav
