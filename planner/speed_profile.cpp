#include "planner/speed_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floornav {
namespace {

constexpr double kGravity_mps2 = 9.81;

double distance_m(const PathPoint& a, const PathPoint& b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

/// 1 up to `least`, 0 from `most` on, linear between.
double share(double value, double least, double most) {
  return most > least ? std::clamp((most - value) / (most - least), 0.0, 1.0) : value < most ? 1.0 : 0.0;
}

/// Full speed on level, even floor with comfortable clearance; creeps along obstacles, on the steepest slope,
/// and over steps of half the height that the wheels take. A quarter of that is left to the map's noise.
double place_limit(const PathPoint& point, double creep, const PlannerSettings& settings,
                   const RobotSettings& robot) {
  const double clearance =
      1.0 - share(point.clearance_m, robot.radius_m, robot.radius_m + settings.comfort_m);
  const double slope = share(point.slope_deg, 0.0, robot.max_slope_deg);
  const double step = share(point.step_m, 0.25 * robot.max_step_m, 0.5 * robot.max_step_m);
  const double rough = share(point.roughness_m, 0.125 * robot.max_step_m, 0.5 * robot.max_step_m);
  return creep + (robot.max_speed_mps - creep) * std::min({clearance, slope, step, rough});
}

/// All turns between two neighbours on the way back from a point as far as `reach_m`, added up.
double turned_before(const std::vector<PathPoint>& points, std::size_t i, double reach_m) {
  double turned_rad = 0;
  for (double gone_m = 0; i > 0; --i) {
    gone_m += distance_m(points[i], points[i - 1]);
    if (gone_m > reach_m) break;
    turned_rad +=
        std::abs(std::remainder(points[i].heading_rad - points[i - 1].heading_rad, 2 * std::numbers::pi));
  }
  return turned_rad;
}

/// The turns that lie close together before a point are driven as one arc as long as a spacing.
double turn_limit(const std::vector<PathPoint>& points, std::size_t i, double spacing_m,
                  const RobotSettings& robot) {
  constexpr double kRounding = 1.0 + 1e-6;
  const double turn_rad = turned_before(points, i, kRounding * spacing_m);
  if (turn_rad <= 0) return robot.max_speed_mps;
  // Half of the sideways acceleration that would tip it over.
  const double sideways_mps2 = 0.5 * kGravity_mps2 * 0.5 * robot.track_m / robot.center_of_gravity_m;
  return std::min(robot.max_turn_rate_radps * spacing_m / turn_rad,
                  std::sqrt(sideways_mps2 * spacing_m / turn_rad));
}

}  // namespace

void set_speeds(std::vector<PathPoint>& points, const PlannerSettings& settings, const RobotSettings& robot) {
  if (points.empty()) return;
  const double creep = std::min(settings.creep_speed_mps, robot.max_speed_mps);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].speed_mps = place_limit(points[i], creep, settings, robot);
    points[i].speed_mps =
        std::min(points[i].speed_mps, turn_limit(points, i, settings.point_spacing_m, robot));
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
