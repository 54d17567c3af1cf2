#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/simulator/shapes.hpp"

namespace floornav {

/// Someone who walks from one place to another and back again, for ever.
struct Person {
  Eigen::Vector2d from_m{0, 0};
  Eigen::Vector2d to_m{1, 0};
  double speed_mps = 1.0;
  double height_m = 1.75;
  double start_s = 0;  ///< stands at `from` until then

  /// The middle of the body after walking (and waiting for start_s) for a time.
  [[nodiscard]] Eigen::Vector2d place_m(double time_s) const;
};

/// The way that the robot is driven in an open loop: a smooth curve (cubic B-spline) that follows the
/// waypoints.
struct DrivePlan {
  std::vector<Eigen::Vector2d> waypoints_m;
  double speed_mps = 0.8;
};

/// A world whose truth is known. Its frame is the robot's local frame: z up, floor near z = 0.
struct Scene {
  std::string name;
  Eigen::Vector2d area_min_m{-1, -3};  ///< the part of the world that the truth tells of
  Eigen::Vector2d area_max_m{9, 3};
  Shapes fixed;
  std::vector<Person> people;
  std::optional<DrivePlan> drive;
  std::optional<Eigen::Vector2d> goal_m;

  /// Everything that stands there at a time since the start.
  [[nodiscard]] Shapes at(double time_s) const;
  /// The people alone, each at a time of their own.
  [[nodiscard]] std::vector<Cylinder> people_at(std::span<const double> times_s) const;
};

}  // namespace floornav
