#pragma once

#include <cstdint>
#include <optional>

#include "floornav/surfels_t.hpp"
#include "perception/evidence.hpp"

namespace floornav {

/// One frame's evidence, put together from its messages.
struct FrameEvidence {
  std::int64_t frame = 0;
  std::int8_t sensor = 0;  ///< as depth_cloud_t.sensor
  FloorEvidence evidence;  ///< a surfel that several messages carry stands here once; cells keep no surfel
};

/// Collects the parts of one frame after the other, as they come in a replay: all of them, in order.
class FrameCollector {
 public:
  /// The frame that this message completes. Throws std::invalid_argument for a corrupt one.
  std::optional<FrameEvidence> add(const surfels_t& message);

 private:
  FrameEvidence collected_;
};

}  // namespace floornav
