#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "drivers/bumblebee/calibration/chessboards.hpp"

namespace floornav {

/// What to calibrate from: images in pairs, left[i] with right[i].
struct CalibrationTask {
  std::vector<std::filesystem::path> left;
  std::vector<std::filesystem::path> right;
  Chessboard board;
  std::filesystem::path result;    ///< OpenCV's YAML
  std::filesystem::path pictures;  ///< folder for the rectified pairs; empty: none
};

/// Finds the boards, calibrates, writes the result and the pictures. Result: lines of a report for a person.
/// `before_each` is called before each pair and may throw. Throws std::runtime_error where images cannot be
/// read, are of unequal size, or too few pairs show the board.
std::vector<std::string> calibrate_from_files(
    const CalibrationTask& task, const std::function<void(std::int64_t, std::int64_t)>& before_each);

}  // namespace floornav
