#include "drivers/bumblebee/calibration/chessboards.hpp"

#include <cmath>
#include <stdexcept>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace floornav {
namespace {

std::vector<cv::Point2f> corners_of(const cv::Mat& image, const Chessboard& board) {
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(image, size, corners)) return {};
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-3);
  cv::cornerSubPix(image, corners, {5, 5}, {-1, -1}, until);
  return corners;
}

std::vector<cv::Point3f> board_points(const Chessboard& board) {
  std::vector<cv::Point3f> points;
  for (int y = 0; y < board.rows; ++y)
    for (int x = 0; x < board.columns; ++x)
      points.emplace_back(static_cast<float>(x * board.square_m), static_cast<float>(y * board.square_m),
                          0.0F);
  return points;
}

/// Mean difference of rows after rectification.
double epipolar_px(const StereoCalibration& calibration, const CornerPair& pair) {
  cv::Matx33d R_left;
  cv::Matx33d R_right;
  cv::Matx34d P_left;
  cv::Matx34d P_right;
  cv::Matx44d unused;
  cv::stereoRectify(calibration.left.camera, calibration.left.distortion, calibration.right.camera,
                    calibration.right.distortion, calibration.left.size, calibration.R_right_left,
                    calibration.t_right_left_m, R_left, R_right, P_left, P_right, unused);
  std::vector<cv::Point2f> left;
  std::vector<cv::Point2f> right;
  cv::undistortPoints(pair.left, left, calibration.left.camera, calibration.left.distortion, R_left, P_left);
  cv::undistortPoints(pair.right, right, calibration.right.camera, calibration.right.distortion, R_right,
                      P_right);
  double sum = 0;
  for (std::size_t i = 0; i < left.size(); ++i) sum += std::abs(static_cast<double>(left[i].y - right[i].y));
  return sum / static_cast<double>(left.size());
}

}  // namespace

CornerPair find_corners(const cv::Mat& left, const cv::Mat& right, const Chessboard& board) {
  CornerPair pair{corners_of(left, board), corners_of(right, board)};
  if (pair.left.empty() || pair.right.empty()) return {};
  return pair;
}

CalibrationReport calibrate(const std::vector<CornerPair>& pairs, cv::Size image, const Chessboard& board) {
  if (pairs.size() < 3) throw std::runtime_error("at least three pairs that show the whole board are needed");
  const std::vector<std::vector<cv::Point3f>> boards(pairs.size(), board_points(board));
  std::vector<std::vector<cv::Point2f>> left;
  std::vector<std::vector<cv::Point2f>> right;
  for (const CornerPair& pair : pairs) {
    left.push_back(pair.left);
    right.push_back(pair.right);
  }
  CalibrationReport report;
  StereoCalibration& found = report.calibration;
  found.left.size = found.right.size = image;
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 200, 1e-9);
  constexpr int kModel = cv::CALIB_SAME_FOCAL_LENGTH | cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K3;
  found.left.camera = cv::initCameraMatrix2D(boards, left, image);
  found.right.camera = cv::initCameraMatrix2D(boards, right, image);
  cv::Mat essential;
  cv::Mat fundamental;
  cv::Mat by_pair;
  report.rms_px =
      cv::stereoCalibrate(boards, left, right, found.left.camera, found.left.distortion, found.right.camera,
                          found.right.distortion, image, found.R_right_left, found.t_right_left_m, essential,
                          fundamental, by_pair, kModel | cv::CALIB_USE_INTRINSIC_GUESS, until);
  for (int i = 0; i < by_pair.rows; ++i) {
    const double left_px = by_pair.at<double>(i, 0);
    const double right_px = by_pair.at<double>(i, 1);
    report.pair_rms_px.push_back(std::sqrt(0.5 * (left_px * left_px + right_px * right_px)));
  }
  check(found);
  for (const CornerPair& pair : pairs) report.pair_epipolar_px.push_back(epipolar_px(found, pair));
  return report;
}

}  // namespace floornav
