#pragma once

#include <optional>

#include "runtime/geometry/pose.hpp"

namespace floornav {

/// Heading of a camera in the horizontal plane, rad. That of its optical axis; where the camera looks steeply
/// down or up, of the direction in which the top (bottom) of its image leans, with a smooth passage between
/// the two. Nothing where neither tells (a camera that looks straight down, turned over).
std::optional<double> camera_heading(const Pose& T_world_camera);

/// Puts a level body under a camera, on the plane z = floor_z.
class BodyUnderCamera {
 public:
  explicit BodyUnderCamera(double floor_z_m) : floor_z_m_(floor_z_m) {}

  /// The body's pose for the camera's. A camera without a heading keeps the one before.
  Pose operator()(const Pose& T_world_camera);

 private:
  double floor_z_m_;
  double heading_rad_ = 0;
};

/// Sensor (x right, y down, z forward) above the body's origin: pitch positive looks down, roll positive
/// leans to the left: its left side is the lower one. Radians.
Pose mounted_sensor(double height_m, double pitch_rad, double roll_rad);

}  // namespace floornav
