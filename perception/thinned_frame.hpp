#pragma once

#include <cstdint>
#include <vector>

#include "perception/depth_frame.hpp"

namespace floornav {

/// A frame of every n-th pixel of every n-th row, as a camera of that resolution would have taken it.
class ThinnedFrame {
 public:
  /// The result lasts until the next call, and as long as `frame`'s pixels do.
  DepthFrame thin(const DepthFrame& frame, int stride);

 private:
  std::vector<std::uint16_t> pixels_;
  std::vector<std::uint8_t> uncertainty_;
};

}  // namespace floornav
