#pragma once

#include <vector>

#include <Eigen/Core>

#include "tools/simulator/scene.hpp"

namespace floornav {

/// Where a driven robot is at one instant, seen from above.
struct PlanarState {
  Eigen::Vector2d position_m{0, 0};
  Eigen::Vector2d ahead{1, 0};  ///< unit vector
};

/// A smooth drive along a plan: a cubic B-spline from the first waypoint to the last, from standstill to
/// standstill at a constant acceleration.
class Trajectory {
 public:
  Trajectory(const DrivePlan& plan, double acceleration_mps2);

  [[nodiscard]] double duration_s() const { return duration_s_; }
  [[nodiscard]] double length_m() const { return arc_m_.back(); }
  /// Before 0 the robot stands at the beginning, after duration_s() at the end.
  [[nodiscard]] PlanarState at(double time_s) const;

 private:
  [[nodiscard]] double travelled_m(double time_s) const;

  std::vector<Eigen::Vector2d> points_;  ///< close together along the curve
  std::vector<double> arc_m_;            ///< length up to each
  double speed_mps_;
  double acceleration_mps2_;
  double duration_s_;
};

}  // namespace floornav
