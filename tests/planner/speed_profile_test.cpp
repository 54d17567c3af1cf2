#include "planner/speed_profile.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace floornav {
namespace {

/// Points every 0.1 m along x in the open.
std::vector<PathPoint> straight_path(std::size_t count) {
  std::vector<PathPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i].x_m = 0.1 * static_cast<double>(i);
    points[i].clearance_m = 5.0;
  }
  return points;
}

TEST(SpeedProfile, BrakesToRestAtTheEndByTheRobotsAcceleration) {
  auto points = straight_path(60);
  RobotSettings robot;
  set_speeds(points, {}, robot);
  EXPECT_DOUBLE_EQ(points[0].speed_mps, robot.max_speed_mps);
  for (const PathPoint& p : points) {
    const double left_m = points.back().x_m - p.x_m;
    EXPECT_NEAR(p.speed_mps, std::min(1.0, std::sqrt(2 * robot.max_acceleration_mps2 * left_m)), 1e-9);
  }
}

TEST(SpeedProfile, CreepsAlongAnObstacleAndOnTheSteepestSlope) {
  auto points = straight_path(60);
  RobotSettings robot;
  points[20].clearance_m = robot.radius_m;
  points[40].slope_deg = robot.max_slope_deg;
  PlannerSettings settings;
  set_speeds(points, settings, robot);
  EXPECT_DOUBLE_EQ(points[20].speed_mps, settings.creep_speed_mps);
  EXPECT_DOUBLE_EQ(points[40].speed_mps, settings.creep_speed_mps);
  EXPECT_GT(points[30].speed_mps, 0.9);
}

TEST(SpeedProfile, SlowsForACornerByTheTurnRate) {
  auto points = straight_path(60);
  for (std::size_t i = 30; i < points.size(); ++i) {
    points[i].heading_rad = 1.0;
    points[i].x_m = points[29].x_m + 0.1 * static_cast<double>(i - 29) * std::cos(1.0);
    points[i].y_m = 0.1 * static_cast<double>(i - 29) * std::sin(1.0);
  }
  points[29].heading_rad = 1.0;
  RobotSettings robot;
  set_speeds(points, {}, robot);
  EXPECT_NEAR(points[29].speed_mps, robot.max_turn_rate_radps * 0.1 / 1.0, 1e-9);
}

TEST(SpeedProfile, NeverAsksForMoreThanTheAcceleration) {
  auto points = straight_path(100);
  for (std::size_t i = 0; i < points.size(); i += 7)
    points[i].clearance_m = 0.45 + 0.01 * static_cast<double>(i % 30);
  RobotSettings robot;
  set_speeds(points, {}, robot);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double a = points[i - 1].speed_mps, b = points[i].speed_mps;
    EXPECT_LE(std::abs(b * b - a * a) / 2 / 0.1, robot.max_acceleration_mps2 + 1e-9);
  }
}

}  // namespace
}  // namespace floornav
