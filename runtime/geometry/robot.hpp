#pragma once

#include <vector>

#include "runtime/geometry/settings.hpp"

namespace floornav {

/// A corner of the robot's outline, in the body frame.
struct FootprintCorner {
  double x_m = 0;  ///< forward
  double y_m = 0;  ///< to the left
};

template <class Visitor>
void visit_settings(Visitor& visit, FootprintCorner& s) {
  visit("x_m", s.x_m, Allowed{-5.0, 5.0});
  visit("y_m", s.y_m, Allowed{-5.0, 5.0});
}

/// The robot as the cores see it. Defaults: a MobileRobots PowerBot.
struct RobotSettings {
  double radius_m = 0.45;                  ///< circle around the body's origin that holds the footprint
  std::vector<FootprintCorner> footprint;  ///< its outline, whose convex hull counts; empty: that circle
  double footprint_margin_m = 0.02;        ///< kept free around the outline
  double height_m = 0.75;                  ///< with sensors: lower things block, higher ones do not
  double ground_clearance_m = 0.04;        ///< under the chassis
  double max_step_m = 0.02;                ///< T of eq. (2): the highest step that the wheels take
  double max_slope_deg = 10.0;             ///< steepest floor that it drives
  double center_of_gravity_m = 0.30;       ///< above the floor
  double track_m = 0.54;                   ///< between the wheels, for tipping over
  double max_speed_mps = 1.0;
  double max_acceleration_mps2 = 0.5;
  double max_turn_rate_radps = 1.5;
};

template <class Visitor>
void visit_settings(Visitor& visit, RobotSettings& s) {
  visit("radius_m", s.radius_m, Allowed{0.05, 5.0});
  visit("footprint", s.footprint);
  visit("footprint_margin_m", s.footprint_margin_m, Allowed{0.0, 1.0});
  visit("height_m", s.height_m, Allowed{0.05, 5.0});
  visit("ground_clearance_m", s.ground_clearance_m, Allowed{0.001, 1.0});
  visit("max_step_m", s.max_step_m, Allowed{0.001, 1.0});
  visit("max_slope_deg", s.max_slope_deg, Allowed{0.0, 60.0});
  visit("center_of_gravity_m", s.center_of_gravity_m, Allowed{0.01, 5.0});
  visit("track_m", s.track_m, Allowed{0.05, 5.0});
  visit("max_speed_mps", s.max_speed_mps, Allowed{0.01, 20.0});
  visit("max_acceleration_mps2", s.max_acceleration_mps2, Allowed{0.01, 20.0});
  visit("max_turn_rate_radps", s.max_turn_rate_radps, Allowed{0.01, 20.0});
}

}  // namespace floornav
