#pragma once

#include <cstdint>

#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// How the map follows a world that changes, by a robot that stands and sees ten frames a second.
struct MapChange {
  double trail = 0;       ///< share of the floor in view wrongly blocked, 1 s after a person left: worst walk
  double trail_mean = 0;  ///< of all walks
  int frames_until_blocked = 0;  ///< from a box put down to most of it blocked: worst
  double eroded = 0;  ///< share of a standing box's cells that were no more blocked after the walk: worst
};

struct MapChangeOptions {
  int walks = 4;
  int width = 640;  ///< px of the Kinect's image
  std::uint64_t seed = 1;
};

/// People who walk through rooms with a box, and another box that is put down after they have left.
MapChange measure_map_change(const MapChangeOptions& options, Parallel& parallel);

}  // namespace floornav
