#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "tests/devices/firewire/eye_scene.hpp"
#include "tests/devices/mapped_file.hpp"

namespace floornav {

/// A file of raw eye images, mapped.
class SeenEyes {
 public:
  /// Throws std::runtime_error for what is no such file.
  explicit SeenEyes(const char* path);

  [[nodiscard]] const EyeSceneHeader& header() const { return header_; }
  [[nodiscard]] std::string_view calibration() const;
  /// The image of an eye at step n of the camera.
  [[nodiscard]] std::span<const std::uint8_t> image(std::int64_t step, int eye) const;

 private:
  MappedFile file_;
  EyeSceneHeader header_;
};

}  // namespace floornav
