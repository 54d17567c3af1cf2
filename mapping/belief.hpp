#pragma once

namespace floornav {

/// Section 4.6: how far a surfel's height above (or below) the floor lets a robot on it, 0..1: 1 at the
/// floor, linearly to 0 at 0.75 m.
float height_term(float above_floor_m);

/// Section 4.6: the same for the surfel's angle to the horizontal: 1 at 0 degrees, linearly to 0.2 at 60, on
/// to 0 at 75.
float slope_term(float slope_deg);

/// Belief that a vertex is navigable, eq. (1).
inline float belief(float above_floor_m, float slope_deg) {
  return height_term(above_floor_m) * slope_term(slope_deg);
}

}  // namespace floornav
