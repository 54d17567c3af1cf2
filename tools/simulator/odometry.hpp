#pragma once

#include <cstdint>

#include "runtime/geometry/pose.hpp"
#include "tools/simulator/random.hpp"

namespace floornav {

/// How a robot errs about its own pose.
struct PoseNoise {
  double position_m = 0;       ///< 1 sigma of each axis, new at every measurement; 0.01 is a common robot
  double angle_deg = 0;        ///< 1 sigma of each axis, new at every measurement; 0.3 is a common robot
  double drift_per_m = 0;      ///< error of the distance travelled, m per m
  double drift_deg_per_m = 0;  ///< error of the heading: a random walk, deg per sqrt(m)
};

/// Turns the true poses, one after the other, into what the robot believes.
class Odometry {
 public:
  Odometry(const PoseNoise& noise, std::uint64_t seed);
  Pose measure(const Pose& T_world_body);

 private:
  void advance(const Pose& T_world_body);

  PoseNoise noise_;
  RandomStream random_;
  bool started_ = false;
  Pose last_true_ = Pose::Identity();
  Pose drifted_ = Pose::Identity();
};

}  // namespace floornav
