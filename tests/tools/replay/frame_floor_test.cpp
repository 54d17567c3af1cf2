#include "tools/replay/frame_floor.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

/// A floor surfel at a place on the plane through (0, 0, z) that leans to the side by an angle about x.
Surfel floor_at(double x, double y, double z, double lean_deg, int points) {
  Surfel surfel;
  const double lean = lean_deg * kRadPerDeg;
  surfel.normal = Eigen::Vector3d(0, -std::sin(lean), std::cos(lean)).cast<float>();
  surfel.centroid_m = Eigen::Vector3d(x, y, z + y * std::tan(lean));
  surfel.points = points;
  surfel.dominant = surfel.traversable = true;
  return surfel;
}

/// Axes of a level camera that looks along x: right, down, ahead.
Pose level_camera(double height_m) {
  Pose pose = Pose::Identity();
  pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  pose.translation().z() = height_m;
  return pose;
}

TEST(FrameFloor, TellsTheCamerasHeightAboveALeaningFloor) {
  const std::vector<Surfel> surfels{floor_at(1, 0.5, 0.1, 5, 1000), floor_at(2, -0.5, 0.1, 5, 3000)};
  const FrameFloor floor = floor_of(surfels, level_camera(0.9));
  EXPECT_EQ(floor.points, 4000);
  EXPECT_NEAR(floor.tilt_deg, 5, 1e-3);
  EXPECT_NEAR(floor.camera_height_m, 0.8 * std::cos(5 * kRadPerDeg), 1e-6);
  EXPECT_NEAR(floor.camera_pitch_deg, 0, 1e-3);
  EXPECT_NEAR(floor.camera_roll_deg, 5, 1e-3);  // the floor rises at the left: the left side is the lower one
}

TEST(FrameFloor, TellsTheCamerasPitch) {
  Pose camera = level_camera(0.5);
  camera.rotate(Eigen::AngleAxisd(-20 * kRadPerDeg, Eigen::Vector3d::UnitX()));  // its axes: ahead sinks
  const FrameFloor floor = floor_of({floor_at(1, 0, 0, 0, 10)}, camera);
  EXPECT_NEAR(floor.camera_pitch_deg, 20, 1e-3);
  EXPECT_NEAR(floor.camera_height_m, 0.5, 1e-6);
}

TEST(FrameFloor, LeavesOutWhatIsNoFloorOrAnotherLevel) {
  Surfel table = floor_at(1, 0, 0.7, 0, 90000);
  table.traversable = false;
  Surfel second = floor_at(1, 0, 0, 0, 50000);
  second.dominant = false;
  const Surfel platform = floor_at(3, 0, 0.05, 0, 500);
  const Surfel ramp = floor_at(2, 0, 0, 8, 500);
  const FrameFloor floor =
      floor_of({table, second, floor_at(1, 0, 0, 0, 1000), platform, ramp}, level_camera(1));
  EXPECT_EQ(floor.points, 1000);
  EXPECT_NEAR(floor.height_m, 0, 1e-9);
}

TEST(FrameFloor, IsToldAsAbsentWhereThereIsNone) {
  const FrameFloor floor = floor_of({}, level_camera(1));
  EXPECT_EQ(floor.points, 0);
  EXPECT_TRUE(std::isnan(floor.camera_height_m));
}

}  // namespace
}  // namespace floornav
