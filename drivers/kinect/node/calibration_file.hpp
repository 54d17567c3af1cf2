#pragma once

#include <filesystem>

#include "drivers/kinect/lens.hpp"
#include "runtime/geometry/pinhole.hpp"

namespace floornav {

/// A depth camera's calibration.
struct Calibration {
  Pinhole camera;
  Distortion distortion{};
};

/// From a YAML file as ROS's camera_calibration writes it (image_width, image_height, camera_matrix and
/// distortion_coefficients with data), scaled to an image of this size. Throws SettingsError where something
/// is missing or no such camera can be.
Calibration read_calibration(const std::filesystem::path& file, int width, int height);

}  // namespace floornav
