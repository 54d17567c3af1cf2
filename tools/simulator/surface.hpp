#pragma once

#include <limits>

#include "tools/simulator/shapes.hpp"

namespace floornav {

/// What a wheel at one place finds.
struct SurfacePoint {
  double z_m = 0;    ///< what rests on the ground there, up to the first gap
  double slope = 0;  ///< tangent of the steepest way up
  double clearance_m =
      std::numeric_limits<double>::infinity();  ///< from z to the underside of what hangs above
};

/// The exact surface at one place: ground, and everything that stands on it without a gap.
SurfacePoint surface_at(const Shapes& shapes, const Eigen::Vector2d& place);

/// The exact highest point at one place of all that begins lower than `ceiling_m` (z): a table's top counts
/// where its underside is below the ceiling.
double top_at(const Shapes& shapes, const Eigen::Vector2d& place, double ceiling_m);

}  // namespace floornav
