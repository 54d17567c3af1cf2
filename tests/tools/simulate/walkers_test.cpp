#include "tools/simulate/walkers.hpp"

#include <gtest/gtest.h>

#include "tools/simulator/scene_file.hpp"

namespace floornav {
namespace {

/// Somebody walks along x = 1.5 from y = -2 to 2 and back, 1 m a second.
Scene scene_with_person() {
  Scene scene = parse_scene("name: test\narea_m: [-2, -3, 6, 3]\ngoal_m: [4, 0]\nobjects: []\n", "test.yaml");
  scene.people.push_back({{1.5, -2.0}, {1.5, 2.0}, 1.0, 1.75, 0.0});
  return scene;
}

Eigen::Vector2d place_of_person(const Walkers& walkers) {
  return walkers.world().cylinders.back().center_m.head<2>();
}

TEST(Walkers, WalkOnWhereNobodyIsInTheirWay) {
  const Scene scene = scene_with_person();
  Walkers walkers(scene);
  for (int i = 0; i < 200; ++i) walkers.walk({-5, 0}, 0.01);
  EXPECT_NEAR(place_of_person(walkers).y(), 0.0, 0.02);
}

TEST(Walkers, WaitForTheRobotAndGoOnWhenItHasGone) {
  const Scene scene = scene_with_person();
  Walkers walkers(scene);
  for (int i = 0; i < 500; ++i) {
    walkers.walk({1.5, 0}, 0.01);
    ASSERT_GE((place_of_person(walkers) - Eigen::Vector2d(1.5, 0)).norm(), 1.19);
  }
  EXPECT_NEAR(place_of_person(walkers).y(), -1.2, 0.02);
  for (int i = 0; i < 120; ++i) walkers.walk({-5, 0}, 0.01);
  EXPECT_NEAR(place_of_person(walkers).y(), 0.0, 0.04);
}

TEST(Walkers, TellOfARobotThatRunsIntoThem) {
  const Scene scene = scene_with_person();
  const Walkers walkers(scene);
  EXPECT_EQ(walkers.meeting(DriveBase({}, {{0, 0}, {1, 0}})), "");
  const std::string told = walkers.meeting(DriveBase({}, {{1.3, -2.0}, {1, 0}}));
  EXPECT_NE(told.find("hit a person 0.20 m away"), std::string::npos) << told;
}

}  // namespace
}  // namespace floornav
