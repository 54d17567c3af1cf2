#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include <opencv2/core.hpp>

#include "tests/devices/firewire/eye_scene.hpp"
#include "tools/simulator/stereo/stereo_rig.hpp"

namespace floornav {

/// Writes a file of raw eye images frame by frame.
class EyeSceneWriter {
 public:
  /// What the rig is, is what the virtual camera is: an XB3 with three eyes, a Bumblebee2 with two.
  EyeSceneWriter(const std::filesystem::path& file, const StereoRig& rig, int period_us, bool there_and_back);
  /// `eyes`: the right one's image first.
  void add(const std::vector<cv::Mat>& eyes);
  /// Throws std::runtime_error where not all of it reached the disk.
  void close();

 private:
  std::filesystem::path name_;
  std::ofstream file_;
  EyeSceneHeader header_;
};

}  // namespace floornav
