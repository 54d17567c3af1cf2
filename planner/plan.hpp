#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/route.hpp"

namespace floornav {

/// Where to go, in the local frame.
struct Goal {
  double x_m = 0;
  double y_m = 0;
  double tolerance_m = 0;  ///< the nearest reachable place within it will do
};

enum class PlanStatus : std::uint8_t {
  kFollowing,     ///< the path ends within the goal's tolerance
  kReached,       ///< the robot is there
  kFrontier,      ///< the path ends at the last place towards the goal that is known to be free
  kNoPath,        ///< the goal cannot be reached
  kStartBlocked,  ///< an obstacle reaches into the footprint
  kGoalBlocked,   ///< no room for the robot within the goal's tolerance
  kInterrupted,   ///< the search was told to give up
};

/// A point of the path, local frame.
struct PathPoint {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;  ///< height of the floor
  double slope_deg = 0;
  double step_m = 0;       ///< that the wheels cross there
  double roughness_m = 0;  ///< RMS of the floor along the way
  double heading_rad = 0;  ///< counter-clockwise from x
  double speed_mps = 0;    ///< the most that is safe there
  double clearance_m = 0;  ///< to the nearest cell not known to be free, as far as that is looked for
  bool assumed = false;    ///< the floor there was never seen
};

/// A way to the goal, or why there is none.
struct Plan {
  PlanStatus status = PlanStatus::kNoPath;
  std::string reason;          ///< one line for a person
  std::int32_t map_epoch = 0;  ///< of the map that it rests on
  std::int64_t map_version = 0;
  std::vector<PathPoint> points;   ///< from the robot on; empty: stop. At the last one the speed is 0
  std::size_t way_out_points = 0;  ///< of them, these lead out of where the robot does not fit
  double length_m = 0;             ///< of the points
  Route route;                     ///< the whole way to the goal, unknown floor included
};

}  // namespace floornav
