#pragma once

#include <filesystem>
#include <string>

#include "drivers/bumblebee/stereo_calibration.hpp"

namespace floornav {

/// Reads a stereo calibration in any of these forms; which one is told from the content:
/// - OpenCV's YAML: image_size, M1 D1 M2 D2 R T (T in m);
/// - libbot's BotParam: a block of type "stereo" under `cameras`, named by `block` (needed where there are
///   several);
/// - two sensor.yaml of a EuRoC data set, "LEFT,RIGHT".
/// Throws std::runtime_error "FILE: cause".
StereoCalibration read_stereo_calibration(const std::string& files, const std::string& block = "");

/// Writes OpenCV's YAML. Throws std::runtime_error where the file cannot be written.
void write_stereo_calibration(const StereoCalibration& calibration, const std::filesystem::path& file);

}  // namespace floornav
