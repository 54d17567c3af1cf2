#pragma once

#include <vector>

#include "perception/evidence.hpp"

namespace floornav {

/// The floor as one frame saw it: its surfels that agree with the largest dominant traversable one.
struct FrameFloor {
  int points = 0;               ///< on the floor's surfels; 0: no floor found, the rest is NaN
  double height_m = 0;          ///< z in the local frame, at the middle of these points
  double tilt_deg = 0;          ///< angle between the floor's normal and the vertical
  double camera_height_m = 0;   ///< of the sensor above the floor's plane
  double camera_pitch_deg = 0;  ///< of the sensor against the floor, positive looks down
  double camera_roll_deg = 0;   ///< positive: its left side is the lower one
};

FrameFloor floor_of(const std::vector<Surfel>& surfels, const Pose& T_world_sensor);

}  // namespace floornav
