#include "drivers/bumblebee/stereo_calibration.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace floornav {
namespace {

void check_eye(const Eye& eye, const char* name) {
  const double width = eye.size.width;
  const double height = eye.size.height;
  if (!(width >= 16 && width <= 8192 && height >= 16 && height <= 8192))
    throw std::runtime_error(fmt::format("{} image of {} x {} px", name, width, height));
  const auto require = [&](const char* what, double value, double least, double most) {
    if (!(value >= least && value <= most))
      throw std::runtime_error(
          fmt::format("{} {} is {}, its image allows {} .. {}", name, what, value, least, most));
  };
  require("fx", eye.camera(0, 0), 0.1 * width, 50 * width);
  require("fy", eye.camera(1, 1), 0.1 * width, 50 * width);
  require("cx", eye.camera(0, 2), 0, width);
  require("cy", eye.camera(1, 2), 0, height);
  for (const double k : eye.distortion) require("distortion", k, -100, 100);
}

}  // namespace

void check(const StereoCalibration& calibration) {
  check_eye(calibration.left, "left");
  check_eye(calibration.right, "right");
  if (calibration.left.size != calibration.right.size)
    throw std::runtime_error("left and right images are not of the same size");
  const cv::Matx33d& R = calibration.R_right_left;
  if (!(cv::norm(R.t() * R - cv::Matx33d::eye()) < 1e-3 && cv::determinant(R) > 0))
    throw std::runtime_error("the rotation between the eyes is not a rotation");
  const cv::Vec3d& t = calibration.t_right_left_m;
  const double length_m = cv::norm(t);
  if (!(length_m >= 0.005 && length_m <= 5))
    throw std::runtime_error(fmt::format("baseline of {} m; metres from 0.005 to 5 are allowed", length_m));
  if (t[0] > 0.5 * length_m) throw std::runtime_error("left and right eye are swapped: t_x is positive");
  if (t[0] > -0.5 * length_m) throw std::runtime_error("one eye is above the other, not beside it");
}

}  // namespace floornav
