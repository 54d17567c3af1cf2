#pragma once

#include <opencv2/core.hpp>

namespace floornav {

/// Some rows of an image of half the width and height: means of four pixels.
void halve(const cv::Mat1b& whole, cv::Range rows, cv::Mat1b& half);

/// Some rows of disparities at twice the width and height: between four of one surface bilinear, else those
/// of the nearest.
void enlarge(const cv::Mat1f& half, cv::Range rows, cv::Mat1f& whole);

}  // namespace floornav
