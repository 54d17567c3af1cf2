#pragma once

#include <cstdint>
#include <vector>

#include "runtime/geometry/pose.hpp"
#include "tools/simulator/sensor_spec.hpp"
#include "tools/simulator/shapes.hpp"

namespace floornav {

/// What stands on the floor in a configuration of Table 1, with its measured truth.
struct Obstacle {
  Shapes shape;           ///< one block or one cylinder
  Footprint footprint;    ///< the rectangle around it
  double height_m = 0;    ///< of its highest point
  double distance_m = 0;  ///< along the floor, from the sensor to its centre
  bool sloped = false;
};

/// The part of the floor in front of the robot that Table 1 covers with a sensor.
struct CoveredArea {
  double length_m = 5.5;
  double width_m = 3.0;
};

/// One of Table 1's obstacle configurations: a level floor, a robot somewhere on it, obstacles in its sight.
struct ObstacleCourse {
  Pose T_world_body = Pose::Identity();
  std::vector<Obstacle> obstacles;
  Shapes shapes;  ///< all of them
};

/// Random boxes, sloped boxes and cylinders of 5 to 40 cm, half of them nearer than 3 m, whole in the
/// image, none hidden by another; the robot's place and heading are random, so that nothing is aligned with
/// cells or sections.
ObstacleCourse random_course(const SensorSpec& sensor, const CoveredArea& area, std::uint64_t seed);

}  // namespace floornav
