#pragma once

#include "tools/simulator/shapes.hpp"

namespace floornav {

/// What perception is timed on, ahead of a robot at the origin: a floor with a step of 1 cm, a ramp of 5
/// degrees, boxes of 5 to 40 cm and a wall.
Shapes bench_scene();

}  // namespace floornav
