#include "planner/speed_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floornav {
namespace {

double distance_m(const PathPoint& a, const PathPoint& b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

/// Full speed on level floor with comfortable clearance; creeps along obstacles and on the steepest slope.
double place_limit(const PathPoint& point, double creep, const PlannerSettings& settings,
                   const RobotSettings& robot) {
  const double spare = (point.clearance_m - robot.radius_m) / std::max(settings.comfort_m, 1e-6);
  const double steepness = robot.max_slope_deg > 0 ? point.slope_deg / robot.max_slope_deg : 1.0;
  return creep + (robot.max_speed_mps - creep) * std::clamp(std::min(spare, 1.0 - steepness), 0.0, 1.0);
}

/// A corner is driven as an arc over half the way to each neighbour.
double turn_limit(const PathPoint& before, const PathPoint& here, const PathPoint& after,
                  const RobotSettings& robot) {
  const double turn_rad =
      std::abs(std::remainder(here.heading_rad - before.heading_rad, 2 * std::numbers::pi));
  const double arc_m = 0.5 * (distance_m(before, here) + distance_m(here, after));
  return turn_rad > 0 ? robot.max_turn_rate_radps * arc_m / turn_rad : robot.max_speed_mps;
}

}  // namespace

void set_speeds(std::vector<PathPoint>& points, const PlannerSettings& settings, const RobotSettings& robot) {
  if (points.empty()) return;
  const double creep = std::min(settings.creep_speed_mps, robot.max_speed_mps);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].speed_mps = place_limit(points[i], creep, settings, robot);
    if (i > 0 && i + 1 < points.size())
      points[i].speed_mps =
          std::min(points[i].speed_mps, turn_limit(points[i - 1], points[i], points[i + 1], robot));
  }
  points.back().speed_mps = 0;
  const auto reachable = [&](const PathPoint& from, const PathPoint& to) {
    return std::sqrt(from.speed_mps * from.speed_mps +
                     2 * robot.max_acceleration_mps2 * distance_m(from, to));
  };
  for (std::size_t i = points.size() - 1; i > 0; --i)
    points[i - 1].speed_mps = std::min(points[i - 1].speed_mps, reachable(points[i], points[i - 1]));
  for (std::size_t i = 1; i < points.size(); ++i)
    points[i].speed_mps = std::min(points[i].speed_mps, reachable(points[i - 1], points[i]));
}

}  // namespace floornav
