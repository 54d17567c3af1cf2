#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/stereo_calibration.hpp"

namespace floornav {

/// A flat chessboard: inner corners a row and a column, and the side of its squares.
struct Chessboard {
  int columns = 9;
  int rows = 6;
  double square_m = 0.025;
};

/// The corners of one pair, row by row, px; both empty where one of the images does not show the whole board.
struct CornerPair {
  std::vector<cv::Point2f> left;
  std::vector<cv::Point2f> right;
};

/// 8-bit grey images.
CornerPair find_corners(const cv::Mat& left, const cv::Mat& right, const Chessboard& board);

/// How well a calibration explains the pairs, px.
struct CalibrationReport {
  StereoCalibration calibration;
  double rms_px = 0;                     ///< of all corners' reprojection
  std::vector<double> pair_rms_px;       ///< by pair, both eyes
  std::vector<double> pair_epipolar_px;  ///< by pair, mean difference of a corner's rows once rectified
};

/// Calibrates both eyes and how they stand. Throws std::runtime_error for fewer than three pairs.
CalibrationReport calibrate(const std::vector<CornerPair>& pairs, cv::Size image, const Chessboard& board);

}  // namespace floornav
