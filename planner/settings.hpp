#pragma once

#include "runtime/geometry/settings.hpp"

namespace floornav {

/// What a way costs and how it is shaped. Costs are metres of open, level, known floor that one would rather
/// drive than one more metre of the kind named.
struct PlannerSettings {
  double assumed_radius_m = 0.6;     ///< around the footprint at the start: floor unless seen to be none
  double unknown_cost = 3.0;         ///< a metre never seen
  double belief_cost = 2.0;          ///< a metre of belief 0, less in proportion above
  double slope_cost = 1.0;           ///< a metre of the robot's steepest slope, less in proportion below
  double clearance_cost = 2.0;       ///< a metre along an obstacle, less in proportion up to comfort_m
  double turn_cost = 0.1;            ///< a radian turned: in a way's shape, and against the one that is kept
  double comfort_m = 0.15;           ///< between footprint and obstacle: full speed and no cost from here on
  double max_distance_m = 100.0;     ///< a goal further away is refused
  double detour_m = 2.0;             ///< how far around the map's bounds a way may lead
  double keep_path_ratio = 1.15;     ///< the path is kept until another costs this much less
  double off_path_m = 0.3;           ///< beside the path by more than this, the robot has left it
  double point_spacing_m = 0.1;      ///< of the published points
  double creep_speed_mps = 0.1;      ///< along an obstacle
  double map_timeout_ms = 250.0;     ///< without a message of the map the robot stops
  double frontier_timeout_s = 12.0;  ///< the floor ahead is given up where it could not be seen for so long
  double evidence_timeout_ms = 400.0;  ///< without new evidence in the map the robot stops; sooner, after
                                       ///< 2.5 of its periods, where it comes quicker
  double valid_for_ms = 250.0;         ///< of a published path, from its receipt on
  double pose_timeout_ms = 250.0;      ///< without a pose the robot stops
};

template <class Visitor>
void visit_settings(Visitor& visit, PlannerSettings& s) {
  visit("assumed_radius_m", s.assumed_radius_m, Allowed{0.0, 5.0});
  visit("unknown_cost", s.unknown_cost, Allowed{0.0, 7.0});
  visit("belief_cost", s.belief_cost, Allowed{0.0, 7.0});
  visit("slope_cost", s.slope_cost, Allowed{0.0, 7.0});
  visit("clearance_cost", s.clearance_cost, Allowed{0.0, 7.0});
  visit("turn_cost", s.turn_cost, Allowed{0.0, 5.0});
  visit("comfort_m", s.comfort_m, Allowed{0.0, 2.0});
  visit("max_distance_m", s.max_distance_m, Allowed{1.0, 500.0});
  visit("detour_m", s.detour_m, Allowed{0.5, 50.0});
  visit("keep_path_ratio", s.keep_path_ratio, Allowed{1.0, 3.0});
  visit("off_path_m", s.off_path_m, Allowed{0.05, 5.0});
  visit("point_spacing_m", s.point_spacing_m, Allowed{0.02, 1.0});
  visit("creep_speed_mps", s.creep_speed_mps, Allowed{0.01, 5.0});
  visit("map_timeout_ms", s.map_timeout_ms, Allowed{50.0, 10000.0});
  visit("frontier_timeout_s", s.frontier_timeout_s, Allowed{1.0, 600.0});
  visit("evidence_timeout_ms", s.evidence_timeout_ms, Allowed{50.0, 10000.0});
  visit("valid_for_ms", s.valid_for_ms, Allowed{100.0, 2000.0});
  visit("pose_timeout_ms", s.pose_timeout_ms, Allowed{50.0, 10000.0});
}

}  // namespace floornav
