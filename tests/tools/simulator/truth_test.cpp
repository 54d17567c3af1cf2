#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tools/simulator/drivable.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/scene_file.hpp"
#include "tools/simulator/surface.hpp"
#include "tools/simulator/trajectory.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

Scene scene_of(const std::string& objects) {
  return parse_scene("name: test\narea_m: [-1, -2, 6, 2]\nobjects:\n" + objects, "test.yaml");
}

double height(const Scene& scene, double x, double y) {
  return surface_at(scene.fixed, {x, y}).z_m;
}

TEST(Surface, AStepIsExactOnBothSides) {
  const Scene scene = scene_of("  - box: {center_m: [2, 0], size_m: [2, 4, 0.01]}\n");
  EXPECT_EQ(height(scene, 0.999, 0.3), 0.0);
  EXPECT_DOUBLE_EQ(height(scene, 1.001, 0.3), 0.01);
  EXPECT_EQ(height(scene, 3.001, 0.3), 0.0);
}

TEST(Surface, ARampRisesInAStraightLineAlongItsHeading) {
  const Scene scene =
      scene_of("  - ramp: {center_m: [2, 0], size_m: [2, 1], yaw_deg: 90, to_height_m: 0.2}\n");
  EXPECT_NEAR(height(scene, 2.0, -0.99), 0.001, 1e-12);
  EXPECT_NEAR(height(scene, 2.3, 0.0), 0.1, 1e-12);
  EXPECT_NEAR(height(scene, 2.0, 0.5), 0.15, 1e-12);
  EXPECT_EQ(height(scene, 2.6, 0.0), 0.0);
  EXPECT_NEAR(surface_at(scene.fixed, {2.0, 0.0}).slope, 0.1, 1e-12);
}

TEST(Surface, StairsGoDownTreadByTread) {
  const Scene scene =
      scene_of("  - stairs_down: {center_m: [2, 0], size_m: [1.2, 1], steps: 4, rise_m: 0.15}\n");
  EXPECT_EQ(height(scene, 1.39, 0), 0.0);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(height(scene, 1.4 + 0.3 * i + 0.15, 0), -0.15 * (i + 1), 1e-12);
  EXPECT_EQ(height(scene, 2.61, 0), 0.0);
}

TEST(Surface, CarpetWavesLieBetweenZeroAndTheirAmplitude) {
  const Scene scene =
      scene_of("  - carpet: {center_m: [2, 0], size_m: [1, 1], amplitude_m: 0.02, waves: 2}\n");
  EXPECT_NEAR(height(scene, 1.5, 0), 0.0, 1e-12);
  EXPECT_NEAR(height(scene, 1.75, 0), 0.02, 1e-12);
  EXPECT_NEAR(height(scene, 2.0, 0.2), 0.0, 1e-12);
  EXPECT_NEAR(height(scene, 1.625, 0), 0.02 * 0.5625, 1e-12);
  const double slope = surface_at(scene.fixed, {1.6, 0}).slope;
  EXPECT_NEAR(slope, (height(scene, 1.6001, 0) - height(scene, 1.5999, 0)) / 0.0002, 1e-5);
}

TEST(Surface, UnderATableTheFloorIsTheSurfaceAndTheTopIsSeparate) {
  const Scene scene = scene_of("  - table: {center_m: [2, 0], size_m: [1, 1, 0.7], thickness_m: 0.05}\n");
  const SurfacePoint under = surface_at(scene.fixed, {2.0, 0.0});
  EXPECT_EQ(under.z_m, 0.0);
  EXPECT_NEAR(under.clearance_m, 0.65, 1e-12);
  EXPECT_NEAR(top_at(scene.fixed, {2.0, 0.0}, 0.75), 0.7, 1e-12);
  EXPECT_EQ(top_at(scene.fixed, {2.0, 0.0}, 0.6), 0.0);
  EXPECT_NEAR(height(scene, 1.52, -0.48), 0.7, 1e-12);  // leg and top make one column
}

TEST(Surface, TheGroundMaySlope) {
  const Scene scene =
      parse_scene("name: a\narea_m: [0, 0, 1, 1]\nground: {slope: [0.02, -0.01]}\nobjects: []\n", "a");
  EXPECT_NEAR(height(scene, 3, 2), 0.04, 1e-12);
}

bool drivable(const TruthGrid& truth, double x, double y) {
  return truth.at({x, y})->drivable;
}

TEST(Drivable, StepsUpToTAreAndHigherOnesAreNot) {
  RobotSettings robot;
  for (const double step : {0.01, 0.02, 0.021, 0.05}) {
    const Scene scene =
        scene_of("  - box: {center_m: [3.5, 0], size_m: [3, 4, " + std::to_string(step) + "]}\n");
    const TruthGrid truth = truth_of(scene, robot, 0.1, {0, 0});
    const bool passable = step <= robot.max_step_m;
    EXPECT_TRUE(drivable(truth, 1.55, 0.05));
    EXPECT_EQ(drivable(truth, 1.95, 0.05), passable) << step;  // its border is the step
    EXPECT_EQ(drivable(truth, 3.05, 0.05), passable) << step;  // flat, but reached only over the step
    EXPECT_TRUE(truth.at({3.05, 0.05})->standable);
    EXPECT_EQ(truth.at({1.95, 0.05})->beside_step, !passable) << step;
    EXPECT_FALSE(truth.at({1.55, 0.05})->beside_step);
    EXPECT_FALSE(truth.at({3.05, 0.05})->beside_step);
  }
}

TEST(Drivable, WhatIsTooSteepTooLowOrADropIsNot) {
  const RobotSettings robot;  // 10 degrees, 0.75 m
  const Scene scene = scene_of(
      "  - ramp: {center_m: [1.5, 1], size_m: [1, 0.5], to_height_m: 0.15}\n"   // 8.5 degrees
      "  - ramp: {center_m: [1.5, -1], size_m: [1, 0.5], to_height_m: 0.25}\n"  // 14 degrees
      "  - table: {center_m: [3, 1], size_m: [1, 1, 0.8], thickness_m: 0.03}\n"
      "  - table: {center_m: [3, -1], size_m: [1, 1, 0.7]}\n"
      "  - drop: {center_m: [5, 0], size_m: [1, 1], depth_m: 0.3}\n");
  const TruthGrid truth = truth_of(scene, robot, 0.1, {0, 0});
  EXPECT_TRUE(drivable(truth, 1.25, 1.05));
  EXPECT_FALSE(drivable(truth, 1.25, -0.95));
  EXPECT_TRUE(drivable(truth, 3.05, 1.05));
  EXPECT_FALSE(drivable(truth, 3.05, -0.95));
  EXPECT_FALSE(drivable(truth, 2.55, 0.55));  // a leg
  EXPECT_FALSE(drivable(truth, 5.05, 0.05));
  EXPECT_FALSE(drivable(truth, 4.55, 0.05));  // the edge
  EXPECT_NEAR(truth.at({5.05, 0.05})->height_m, -0.3, 1e-6);
}

TEST(Drivable, WhatCannotBeReachedIsNot) {
  const Scene scene = scene_of("  - wall: {from_m: [3, -3], to_m: [3, 3], height_m: 1}\n");
  const TruthGrid truth = truth_of(scene, RobotSettings{}, 0.1, {0, 0});
  EXPECT_TRUE(drivable(truth, 2.85, 0.05));
  EXPECT_FALSE(drivable(truth, 3.35, 0.05));
  EXPECT_TRUE(truth.at({3.35, 0.05})->standable);
  EXPECT_EQ(truth.at({6.5, 0}), nullptr);
}

TEST(Vehicle, StandsAlongARamp) {
  const Scene scene = scene_of("  - ramp: {center_m: [2, 0], size_m: [3, 3], to_height_m: 0.3}\n");
  const Pose up = body_on_floor(scene.fixed, {{2.0, 0.0}, {1, 0}});
  EXPECT_NEAR(up.translation().z(), 0.15, 1e-9);
  EXPECT_NEAR(up.linear()(2, 0) / up.linear()(0, 0), 0.1, 1e-9);
  const Pose across = body_on_floor(scene.fixed, {{2.0, 0.0}, {0, 1}});
  EXPECT_NEAR(across.linear()(2, 0), 0.0, 1e-9);
  EXPECT_NEAR(across.linear()(2, 1), -0.1 / std::sqrt(1.01), 1e-9);  // left, that is west, is lower
  EXPECT_NEAR(across.linear().determinant(), 1.0, 1e-12);
}

TEST(Trajectory, BeginsAndEndsAtItsEndsAndKeepsItsSpeedAndHeading) {
  const DrivePlan plan{{{0, 0}, {1, 0}, {2, 1}, {3, 1}, {4, -1}}, 0.8};
  const Trajectory trajectory(plan, 0.5);
  EXPECT_NEAR((trajectory.at(-1).position_m - Eigen::Vector2d(0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((trajectory.at(trajectory.duration_s() + 1).position_m - Eigen::Vector2d(4, -1)).norm(), 0.0,
              1e-9);
  constexpr double kStep_s = 0.01;
  for (double t = kStep_s; t + kStep_s < trajectory.duration_s(); t += kStep_s) {
    const Eigen::Vector2d moved =
        trajectory.at(t + kStep_s).position_m - trajectory.at(t - kStep_s).position_m;
    EXPECT_LE(moved.norm() / (2 * kStep_s), 0.8 * 1.001);
    if (moved.norm() < 0.002) continue;
    EXPECT_GT(moved.normalized().dot(trajectory.at(t).ahead), std::cos(0.02)) << t;
    EXPECT_GT(trajectory.at(t - kStep_s).ahead.dot(trajectory.at(t).ahead), std::cos(0.05)) << t;
  }
}

TEST(People, WalkToAndFroAtTheirSpeed) {
  const Scene scene = scene_of("  - person: {from_m: [1, 0], to_m: [3, 0], speed_mps: 1.0, start_s: 2}\n");
  const auto where = [&scene](double t) { return scene.at(t).cylinders.back().center_m.x(); };
  EXPECT_DOUBLE_EQ(where(0), 1.0);
  EXPECT_DOUBLE_EQ(where(3), 2.0);
  EXPECT_DOUBLE_EQ(where(4), 3.0);
  EXPECT_DOUBLE_EQ(where(5), 2.0);
  EXPECT_EQ(scene.at(3).cylinders.size(), 4U);
  EXPECT_TRUE(scene.fixed.cylinders.empty());
}

}  // namespace
}  // namespace floornav
