#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace floornav {

/// One eye of a stereo camera as it is, lens and all.
struct Eye {
  cv::Size size;                               ///< px
  cv::Matx33d camera = cv::Matx33d::eye();     ///< fx 0 cx; 0 fy cy; 0 0 1, px
  std::vector<double> distortion{0, 0, 0, 0};  ///< OpenCV's order: k1 k2 p1 p2 [k3 [k4 k5 k6]]
};

/// Two eyes and how they stand: p_right = R p_left + t.
struct StereoCalibration {
  Eye left;
  Eye right;
  cv::Matx33d R_right_left = cv::Matx33d::eye();
  cv::Vec3d t_right_left_m{0, 0,
                           0};  ///< of a camera with its right eye at the right: about (-baseline, 0, 0)
};

/// Throws std::runtime_error that names the cause where no pair of cameras side by side could have these
/// numbers: eyes of unequal size, impossible intrinsics, no rotation, eyes swapped or one above the other.
void check(const StereoCalibration& calibration);

}  // namespace floornav
