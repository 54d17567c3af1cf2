#pragma once

#include "runtime/geometry/pose.hpp"
#include "tools/simulator/shapes.hpp"
#include "tools/simulator/trajectory.hpp"

namespace floornav {

/// What carries the robot: four wheels of a rectangle around the body's origin.
struct Undercarriage {
  double wheelbase_m = 0.50;
  double track_m = 0.54;
  double wheel_reach_m = 0.10;  ///< before and behind the hub, over which a tyre evens out the floor
};

/// The body as it stands on the floor: origin at the wheels' mean height, x ahead, tilted as the wheels are.
Pose body_on_floor(const Shapes& shapes, const PlanarState& state, const Undercarriage& wheels = {});

}  // namespace floornav
