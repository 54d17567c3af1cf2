#pragma once

#include <cstdint>
#include <vector>

#include "floornav/depth_cloud_t.hpp"

namespace floornav {

/// Some frames of a camera.
struct FrameSamples {
  depth_cloud_t cloud{};                           ///< all but the pixels
  std::vector<std::vector<std::uint16_t>> images;  ///< row by row
};

inline constexpr int kStrips = 4;

/// Processor time of one frame's way from pixels at the driver to pixels in perception (packed, encoded,
/// decoded, unpacked), ms, median over the frames.
struct StripCost {
  double whole_ms = 0;  ///< the frame as one message
  double near_ms = 0;   ///< its lowest strip alone
  double all_ms = 0;    ///< all its strips
};

/// What it would bring to send a frame in strips, the nearest rows first.
StripCost measure_strips(const FrameSamples& samples);

}  // namespace floornav
