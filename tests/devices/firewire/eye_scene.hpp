#pragma once

#include <array>
#include <cstdint>

namespace floornav {

/// What a file of raw eye images begins with; the text of the camera's calibration follows, then the frames,
/// each `eyes` images of width x height bytes, the right eye's first.
struct EyeSceneHeader {
  static constexpr std::array<char, 8> kMagic = {'f', 'n', 'e', 'y', 'e', 's', '0', '1'};

  std::array<char, 8> magic = kMagic;
  std::int32_t width = 0;   ///< px
  std::int32_t height = 0;  ///< px
  std::int32_t eyes = 2;    ///< 2: a Bumblebee2; 3: an XB3
  std::int32_t frames = 0;
  std::int32_t period_us = 0;  ///< between frames
  std::int32_t there_and_back = 0;
  std::array<char, 4> bayer{};  ///< of a colour camera; "YYYY": mono
  std::int32_t calibration_bytes = 0;
};

}  // namespace floornav
