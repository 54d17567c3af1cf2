#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/geometry/pose.hpp"
#include "tools/simulator/shapes.hpp"

namespace floornav {

/// Where the edges of a step course lie, m along the floor in front of the sensor.
inline constexpr std::array<double, 6> kStepDistances_m{1.0, 2.0, 2.5, 3.0, 4.0, 5.0};

/// One edge of a raised strip of floor, at one distance.
struct StepEdge {
  Eigen::Vector2d middle_m;  ///< in front of the sensor
  Eigen::Vector2d across;    ///< unit vector, away from the robot, at right angles to the edge
  double rise_m = 0;         ///< going away from the robot: positive up
  double hidden_m = 0;       ///< floor behind the edge, where it falls, that the camera does not see
};

/// A floor with strips of one height whose edges lie at kStepDistances_m, all turned by one random angle, so
/// that one image shows a step at every distance; the robot's place and heading in the world are random, so
/// that nothing is aligned with cells or sections. In half of the courses the robot stands on the first
/// strip: each edge rises there that falls in the others.
struct StepCourse {
  Pose T_world_body = Pose::Identity();  ///< at the last frame
  Shapes shapes;
  std::vector<StepEdge> edges;  ///< one for each distance
};

StepCourse step_course(double height_m, std::uint64_t seed);

/// A level or gently sloped floor without any step, seen from a random pose.
StepCourse plain_course(std::uint64_t seed);

}  // namespace floornav
