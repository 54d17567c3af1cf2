#include "tools/import/ground_pose.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

/// A camera in the world by its axes' directions: heading, then pitch down, then roll.
Pose camera(double heading_deg, double pitch_deg, double roll_deg) {
  const double h = heading_deg * kRadPerDeg;
  const double p = pitch_deg * kRadPerDeg;
  const double r = roll_deg * kRadPerDeg;
  const Eigen::Vector3d ahead(std::cos(h) * std::cos(p), std::sin(h) * std::cos(p), -std::sin(p));
  const Eigen::Vector3d level_right(std::sin(h), -std::cos(h), 0);
  const Eigen::Vector3d level_down = ahead.cross(level_right);
  Pose T_world_camera = Pose::Identity();
  T_world_camera.linear().col(0) = std::cos(r) * level_right + std::sin(r) * level_down;
  T_world_camera.linear().col(1) = std::cos(r) * level_down - std::sin(r) * level_right;
  T_world_camera.linear().col(2) = ahead;
  T_world_camera.translation() = Eigen::Vector3d(1.5, -2.5, 1.2);
  return T_world_camera;
}

class Heading : public testing::TestWithParam<double> {};

TEST_P(Heading, IsThatOfTheOpticalAxisWhateverTheRollUpToSixtyDegreesDownOrUp) {
  for (const double pitch : {-59.0, -20.0, 0.0, 30.0, 59.0})
    for (const double roll : {-180.0, -90.0, 0.0, 45.0})
      EXPECT_NEAR(camera_heading(camera(GetParam(), pitch, roll)).value(), GetParam() * kRadPerDeg, 1e-9);
}

TEST_P(Heading, IsKeptThroughStraightDownAndStraightUp) {
  for (const double pitch : {-90.0, -80.0, -65.0, 65.0, 70.0, 80.0, 89.0, 90.0, 100.0})
    EXPECT_NEAR(camera_heading(camera(GetParam(), pitch, 0)).value(), GetParam() * kRadPerDeg, 1e-9) << pitch;
}

INSTANTIATE_TEST_SUITE_P(AllRound, Heading, testing::Values(-170.0, -90.0, -1.0, 0.0, 33.0, 120.0, 179.0));

TEST(CameraHeading, MovesSmoothlyWhileTheCameraTurnsDown) {
  double last = camera_heading(camera(10, 50, 25)).value();
  for (double pitch = 50; pitch <= 90; pitch += 0.1) {
    const double heading = camera_heading(camera(10, pitch, 25)).value();
    EXPECT_LT(std::abs(heading - last), 1 * kRadPerDeg) << pitch;
    last = heading;
  }
}

TEST(BodyUnderCamera, StandsLevelOnTheFloorUnderTheCamera) {
  const Pose T_world_body = BodyUnderCamera(0.02)(camera(33, 25, -8));
  EXPECT_TRUE(T_world_body.translation().isApprox(Eigen::Vector3d(1.5, -2.5, 0.02), 1e-12));
  EXPECT_TRUE(T_world_body.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_NEAR(heading_of(T_world_body), 33 * kRadPerDeg, 1e-9);
}

TEST(BodyUnderCamera, KeepsItsHeadingWhereTheCameraHasNone) {
  double pitch = 60;  // turned over, optical axis and image top cancel out on the way down
  while (pitch < 80 && camera_heading(camera(-100, pitch, 180))) pitch += 0.001;
  ASSERT_LT(pitch, 80);
  BodyUnderCamera body(0);
  body(camera(40, 0, 0));
  EXPECT_NEAR(heading_of(body(camera(-100, pitch, 180))), 40 * kRadPerDeg, 1e-9);
}

TEST(MountedSensor, SeesTheFloorWhereHeightAndPitchSay) {
  const Pose T_body_sensor = mounted_sensor(0.72, 20 * kRadPerDeg, 0);
  const Eigen::Vector3d on_axis = T_body_sensor * Eigen::Vector3d(0, 0, 0.72 / std::sin(20 * kRadPerDeg));
  EXPECT_TRUE(on_axis.isApprox(Eigen::Vector3d(0.72 / std::tan(20 * kRadPerDeg), 0, 0), 1e-9));
  EXPECT_NEAR((T_body_sensor.linear() * Eigen::Vector3d::UnitX()).y(), -1, 1e-12);
}

TEST(MountedSensor, LeansToTheLeftWithPositiveRoll) {
  const Eigen::Vector3d right = mounted_sensor(1, 0, 10 * kRadPerDeg).linear() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(right.z(), std::sin(10 * kRadPerDeg), 1e-12);
}

}  // namespace
}  // namespace floornav
