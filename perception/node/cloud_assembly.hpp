#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "floornav/depth_cloud_t.hpp"
#include "perception/depth_frame.hpp"

namespace floornav {

/// A whole frame as messages: one, or its strips in order.
using CloudStrips = std::vector<depth_cloud_t>;

/// Puts the strips of one channel's frames together.
class CloudAssembly {
 public:
  /// Takes the next message; returns the frame that it completes.
  std::optional<CloudStrips> add(const depth_cloud_t& cloud);

  /// Frames given up since a strip of theirs was missing or contradicted the ones before.
  [[nodiscard]] std::int64_t incomplete() const { return incomplete_; }

 private:
  CloudStrips strips_;
  std::int64_t incomplete_ = 0;
};

/// The frame's pixels; the memory that DepthFrame's spans point to.
struct FramePixels {
  std::vector<std::uint16_t> pixels;
  std::vector<std::uint8_t> uncertainty;
  std::vector<std::uint16_t> strip;
};

/// Decodes and checks every strip. Throws CorruptDepth with the cause. `memory` must outlive the result.
DepthFrame unpack_frame(const CloudStrips& strips, FramePixels& memory);

}  // namespace floornav
