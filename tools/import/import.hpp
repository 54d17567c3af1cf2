#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/bumblebee/stereo_matcher.hpp"
#include "runtime/geometry/pinhole.hpp"
#include "tools/import/imported_sensor.hpp"

namespace floornav {

/// Called before each image or cloud with how many are done and how many there are; may throw to end the
/// import.
using ImportStep = std::function<void(std::int64_t done, std::int64_t total)>;

/// What every import needs.
struct ImportTarget {
  std::filesystem::path log;
  ImportedSensor sensor;
  ImportStep before_each;
};

/// What an import did.
struct ImportReport {
  std::int64_t clouds = 0;
  std::int64_t poses = 0;
  std::int64_t span_us = 0;        ///< first to last cloud
  std::vector<std::string> notes;  ///< lines for a person: what was left out or found out
};

/// A TUM RGB-D folder: depth.txt lists the images, groundtruth.txt holds the camera's poses. The body stands
/// under the camera on z = floor_z with the camera's heading; POSE comes at the ground truth's times and at
/// every cloud's, so that POSE and the sensor's pose in a cloud together are the camera's interpolated one.
struct TumImport {
  std::filesystem::path folder;
  Pinhole camera;
  double counts_per_m = 5000;
  double floor_z_m = 0;
};
ImportReport import_tum(const TumImport& what, const ImportTarget& target);

/// A sensor at a fixed place on a body of which nothing else is known. So that each frame makes a map of its
/// own, the body stands elsewhere for every one: row by row, `per_row` to a row, `spacing_m` apart, the first
/// at the origin and rows going down (-y). Frames are 0.1 s apart.
struct FixedMounting {
  double height_m = 0.72;
  double pitch_deg = 20;
  double roll_deg = 0;
  double spacing_m = 10;
  static constexpr int per_row = 10;
  static constexpr std::int64_t period_us = 100'000;
};

/// Folders of depth images, by name. Counts of 0 and 65535 are no measurement.
struct DepthImport {
  std::vector<std::filesystem::path> folders;
  Pinhole camera;
  double counts_per_m = 1000;
  FixedMounting mounting;
};
ImportReport import_depth(const DepthImport& what, const ImportTarget& target);

/// Organised .pcd clouds, in the order given. Without a camera the one on whose rays a cloud lies is found
/// from it. A cloud off those rays is refused.
struct PcdImport {
  std::vector<std::filesystem::path> files;
  std::optional<Pinhole> camera;
  FixedMounting mounting;
};
ImportReport import_pcd(const PcdImport& what, const ImportTarget& target);

/// A log of the LCM world's older Kinect drivers: kinect.frame_msg_t on a channel. Its POSE is taken where
/// there is one; else the frames are placed as images are. Frames in a form that is not read are left out and
/// told.
struct LcmImport {
  std::filesystem::path log;
  std::string channel = "KINECT_FRAME";
  Pinhole camera;
  FixedMounting mounting;
};
ImportReport import_lcm(const LcmImport& what, const ImportTarget& target);

/// A recording of OpenNI2. The camera is that of its field of view unless one is given.
struct OniImport {
  std::filesystem::path file;
  std::optional<Pinhole> camera;
  FixedMounting mounting;
};
ImportReport import_oni(const OniImport& what, const ImportTarget& target);

/// Two folders of raw stereo images, left and right, taken in pairs by name, and their calibration
/// (read_stereo_calibration). The mounting is that of the real left camera.
struct StereoImport {
  std::filesystem::path left;
  std::filesystem::path right;
  std::string calibration;
  std::string calibration_block;
  StereoSettings matching;
  FixedMounting mounting;
};
ImportReport import_stereo(const StereoImport& what, const ImportTarget& target);

}  // namespace floornav
