#pragma once

#include <cstdint>
#include <span>

#include "tests/devices/kinect/scene_file.hpp"

namespace floornav {

/// A scene file, mapped.
class Scene {
 public:
  /// Throws std::runtime_error for what is no scene file.
  explicit Scene(const char* path);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  [[nodiscard]] const SceneHeader& header() const { return *static_cast<const SceneHeader*>(memory_); }
  /// Depths, row by row, counts of header().count_um.
  [[nodiscard]] std::span<const std::uint16_t> frame_at(std::int64_t step) const;

 private:
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace floornav
