#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

#include "tests/devices/kinect/scene_file.hpp"

namespace floornav {

/// Writes a scene file frame by frame.
class SceneWriter {
 public:
  SceneWriter(const std::filesystem::path& file, const SceneHeader& header);
  void add(std::span<const std::uint16_t> depths);
  /// Throws std::runtime_error where not all of it reached the disk.
  void close(int period_us);

 private:
  std::filesystem::path name_;
  std::ofstream file_;
  SceneHeader header_;
};

}  // namespace floornav
