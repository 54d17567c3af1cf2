#pragma once

#include "mapping/grid_map.hpp"

namespace floornav {

/// What the wheels meet at a place of a path.
struct SurfaceProfile {
  double slope_deg = 0;
  double step_m = 0;       ///< the highest step across the way, slopes apart
  double roughness_m = 0;  ///< RMS of what the floor departs from straight lines along the way
};

/// The floor under the robot's middle and both wheels, a cell and a half before and behind a place where it
/// heads for `heading_rad`. Places never seen count as level.
SurfaceProfile surface_profile(const GridMap& map, double x_m, double y_m, double heading_rad,
                               double track_m);

}  // namespace floornav
