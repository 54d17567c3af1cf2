#pragma once

#include "runtime/geometry/pose.hpp"
#include "runtime/geometry/settings.hpp"

namespace floornav {

/// Where the sensor sits on the robot.
struct MountingSettings {
  double x_m = 0.0;         ///< forward of the body's origin
  double y_m = 0.0;         ///< left of it
  double height_m = 0.72;   ///< above the floor
  double pitch_deg = 20.0;  ///< looks down by so much
  double roll_deg = 0.0;    ///< leans to the right by so much
  double yaw_deg = 0.0;     ///< looks to the left by so much
};

template <class Visitor>
void visit_settings(Visitor& visit, MountingSettings& s) {
  visit("x_m", s.x_m, Allowed{-10.0, 10.0});
  visit("y_m", s.y_m, Allowed{-10.0, 10.0});
  visit("height_m", s.height_m, Allowed{0.0, 10.0});
  visit("pitch_deg", s.pitch_deg, Allowed{-90.0, 90.0});
  visit("roll_deg", s.roll_deg, Allowed{-180.0, 180.0});
  visit("yaw_deg", s.yaw_deg, Allowed{-180.0, 180.0});
}

/// Maps sensor axes (x right, y down, z forward) to the body frame (x forward, y left, z up).
Pose sensor_in_body(const MountingSettings& mounting);

}  // namespace floornav
