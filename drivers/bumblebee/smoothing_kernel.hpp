#pragma once

#include <opencv2/core.hpp>

namespace floornav {

/// Each disparity becomes the mean of those around it that belong to the same surface: a window warped by
/// smooth disparities follows a slanted floor, one warped by noisy ones keeps their noise. Neighbours count
/// by pairs on opposite sides, where they and the pixel lie on one plane: however steep it is, their mean is
/// the pixel's own.
///
/// Some rows of `rough` (px; 0: none) to the same ones of `smooth`, an image of the same size; 0 stays 0, and
/// a margin of half a window stays as it is. Bands of rows are independent work. `window`: px.
void smooth_disparities(const cv::Mat1f& rough, cv::Size window, cv::Range rows, cv::Mat1f& smooth);

}  // namespace floornav
