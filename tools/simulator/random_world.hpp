#pragma once

#include <cstdint>

#include "runtime/geometry/robot.hpp"
#include "tools/simulator/drivable.hpp"
#include "tools/simulator/scene.hpp"

namespace floornav {

/// A room made by chance, with a way through it.
struct RandomWorld {
  Scene scene;  ///< has a goal; the robot starts at the origin, heading along +x
  TruthGrid truth;
};

/// `difficulty` 0: a wide room with a few boxes; 1: a crowded one with low obstacles, thin legs, steps, a
/// ramp and a drop. Rooms without a way from start to goal that leaves 10 cm beside the robot are thrown
/// away: the same seed always makes the same world. `people` walk to and fro over its floor.
RandomWorld random_world(std::uint64_t seed, double difficulty, int people, const RobotSettings& robot);

}  // namespace floornav
