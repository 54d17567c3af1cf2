#pragma once

#include <filesystem>

#include <opencv2/core.hpp>

#include "drivers/bumblebee/calibration/chessboards.hpp"
#include "drivers/bumblebee/rectification.hpp"

namespace floornav {

/// Draws a rectified pair side by side, with level lines: each corner must lie on the same one in both.
/// Throws std::runtime_error where the file cannot be written.
void draw_rectified_pair(const cv::Mat& left, const cv::Mat& right, const Rectification& rectification,
                         const std::filesystem::path& file);

}  // namespace floornav
