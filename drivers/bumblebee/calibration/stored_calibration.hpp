#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/calibration/spline_warp.hpp"
#include "drivers/bumblebee/rectification.hpp"

namespace floornav {

/// What a camera stores of itself: ideal cameras side by side, and how each eye's real image is bent. Lengths
/// are shares of the image's width and height.
///
/// The text is a list of entries `Name value ...`, white space between them, # to the line's end a remark.
/// Taken are FocalLength (x y), ImageCenter (x y), BaseLine (m; of an XB3 the wide pair's and, where given,
/// the narrow one's) and for each eye, right one first, `Warp columns rows` with the coefficients of x and
/// then of y. Other entries are passed over.
struct StoredCalibration {
  cv::Point2d focal_length;
  cv::Point2d image_center;
  std::vector<double> baselines_m;
  std::vector<SplineWarp> eyes;  ///< rectified to raw: right, left; or right, centre, left
};

/// Throws std::runtime_error that names what is missing or cannot be.
StoredCalibration parse_stored_calibration(const std::string& text);

/// The text that parse_stored_calibration() reads.
std::string stored_calibration_text(const StoredCalibration& calibration);

/// Rectifies two eyes of a stored calibration, raw images of `size`; `shrink` as Rectification's. The wide
/// pair is the outer eyes, the narrow one the right and the centre. Throws std::runtime_error where there is
/// no such pair.
Rectification rectification_of(const StoredCalibration& calibration, cv::Size size, bool narrow, int shrink);

}  // namespace floornav
