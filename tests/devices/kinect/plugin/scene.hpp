#pragma once

#include <cstdint>
#include <span>

#include "tests/devices/kinect/scene_file.hpp"
#include "tests/devices/mapped_file.hpp"

namespace floornav {

/// A scene file, mapped.
class Scene {
 public:
  /// Throws std::runtime_error for what is no scene file.
  explicit Scene(const char* path);

  [[nodiscard]] const SceneHeader& header() const {
    return *reinterpret_cast<const SceneHeader*>(file_.bytes().data());
  }
  /// Depths, row by row, counts of header().count_um.
  [[nodiscard]] std::span<const std::uint16_t> frame_at(std::int64_t step) const;

 private:
  MappedFile file_;
};

}  // namespace floornav
