#include "tools/simulate/drive_base.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tools/simulator/scene_file.hpp"

namespace floornav {
namespace {

Shapes world_of(const std::string& objects) {
  return parse_scene("name: test\narea_m: [-2, -2, 8, 2]\nobjects:\n" + objects, "test.yaml").fixed;
}

/// Drives straight on until something is wrong; where, and what.
struct Ride {
  std::string trouble;
  double x_m = 0;
};
Ride drive_on(const Shapes& world) {
  DriveBase base(RobotSettings{}, {});
  Ride ride;
  for (int i = 0; i < 1500 && ride.trouble.empty() && base.state().position_m.x() < 5; ++i) {
    base.move({0.5, 0.0}, 0.01);
    ride.trouble = base.trouble(world);
  }
  ride.x_m = base.state().position_m.x();
  return ride;
}

TEST(DriveBase, CollidesWhereItsFrontMeetsABox) {
  const Ride ride = drive_on(world_of("  - box: {center_m: [3, 0], size_m: [1, 1, 0.3]}\n"));
  EXPECT_EQ(ride.trouble, "hit something");
  EXPECT_NEAR(ride.x_m, 2.5 - 0.5 * DriveBase::kLength_m, 0.02);
}

TEST(DriveBase, PassesWhatIsJustBesideIt) {
  EXPECT_EQ(drive_on(world_of("  - box: {center_m: [3, 0.84], size_m: [1, 1, 0.3]}\n")).trouble, "");
  EXPECT_EQ(drive_on(world_of("  - box: {center_m: [3, 0.79], size_m: [1, 1, 0.3]}\n")).trouble,
            "hit something");
}

TEST(DriveBase, CollidesWithATableThatIsTooLowAndPassesAHighOne) {
  EXPECT_EQ(drive_on(world_of("  - box: {center_m: [3, 0], size_m: [1, 1, 0.1], bottom_m: 0.6}\n")).trouble,
            "hit something above");
  EXPECT_EQ(drive_on(world_of("  - box: {center_m: [3, 0], size_m: [1, 1, 0.1], bottom_m: 0.8}\n")).trouble,
            "");
}

TEST(DriveBase, ClimbsAStepOfItsOwnAndNotAHigherOne) {
  EXPECT_EQ(drive_on(world_of("  - box: {center_m: [3, 0], size_m: [2, 4, 0.02]}\n")).trouble, "");
  EXPECT_EQ(drive_on(world_of("  - box: {center_m: [3, 0], size_m: [2, 4, 0.035]}\n")).trouble,
            "drove up a step");
}

TEST(DriveBase, DrivesARampAndFallsOverAnEdge) {
  EXPECT_EQ(drive_on(world_of("  - ramp: {center_m: [3, 0], size_m: [3, 4], to_height_m: 0.2}\n")).trouble,
            "drove over an edge");
  EXPECT_EQ(drive_on(world_of("  - drop: {center_m: [3, 0], size_m: [1, 4], depth_m: 0.2}\n")).trouble,
            "drove over an edge");
}

TEST(DriveBase, KeepsToItsAccelerations) {
  const RobotSettings robot;
  DriveBase base(robot, {});
  double before = 0;
  for (int i = 0; i < 300; ++i) {
    base.move({1.0, 0.0}, 0.01);
    EXPECT_LE(base.speed_mps() - before, robot.max_acceleration_mps2 * 0.01 + 1e-12);
    before = base.speed_mps();
  }
  EXPECT_NEAR(base.speed_mps(), 1.0, 1e-9);
  EXPECT_NEAR(base.travelled_m(), 2.0, 0.02);  // 1 m while it speeds up, 1 m after
}

}  // namespace
}  // namespace floornav
