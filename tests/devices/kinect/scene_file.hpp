#pragma once

#include <array>
#include <cstdint>

#include "tests/devices/scene_step.hpp"

namespace floornav {

/// What a scene file begins with; the frames follow, one after the other, each width x height depths (uint16,
/// row by row, 0 where there is no measurement).
struct SceneHeader {
  static constexpr std::array<char, 8> kMagic = {'f', 'n', 's', 'c', 'e', 'n', 'e', '1'};

  std::array<char, 8> magic = kMagic;
  std::int32_t width = 0;   ///< px
  std::int32_t height = 0;  ///< px
  std::int32_t frames = 0;
  std::int32_t period_us = 0;  ///< between frames
  std::int32_t count_um = 0;   ///< depth of one count
  std::int32_t there_and_back =
      0;  ///< 1: played to its end, back to its beginning and so on; 0: over and over
  float horizontal_fov_rad = 0;
  float vertical_fov_rad = 0;

  /// The frame that is seen at step n = 0, 1, 2 ... of the camera.
  [[nodiscard]] std::int64_t frame_at(std::int64_t step) const {
    return scene_frame_at(step, frames, there_and_back != 0);
  }
};

}  // namespace floornav
