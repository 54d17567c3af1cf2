#include "tools/simulate/closed_loop.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tools/simulator/scene_file.hpp"
#include "tools/simulator/true_route.hpp"

namespace floornav {
namespace {

RobotSettings power_bot() {
  RobotSettings robot;
  robot.radius_m = 0.52;
  return robot;
}

RandomWorld world_of(const std::string& objects) {
  RandomWorld world;
  world.scene =
      parse_scene("name: test\narea_m: [-2, -3, 6, 3]\ngoal_m: [4, 0]\nobjects:" + objects, "test.yaml");
  world.truth = truth_of(world.scene, power_bot(), 0.05, {0, 0});
  return world;
}

ClosedLoopSettings small_sensor() {
  ClosedLoopSettings settings;
  settings.sensor = kinect(160);
  settings.sensor.rate_hz = 5;
  settings.sensor.T_body_sensor = mounted(0, 0, 0.72, 30);
  settings.patience_s = 2;
  return settings;
}

TEST(ClosedLoop, DrivesRoundABoxToTheGoal) {
  const RandomWorld world = world_of("\n  - box: {center_m: [2.2, 0.1], size_m: [0.5, 0.8, 0.5]}\n");
  const ClosedLoopResult result = drive_world(world, power_bot(), small_sensor(), 1, nullptr);
  EXPECT_EQ(result.outcome, Outcome::kReached) << result.reason;
  EXPECT_GT(result.travelled_m, 4.0);
  EXPECT_LT(result.travelled_m, 1.5 * result.shortest_m);
}

TEST(ClosedLoop, WithTheTrueMapTheWayIsHardlyLongerThanTheShortest) {
  const RandomWorld world = world_of("\n  - box: {center_m: [2.2, 0.1], size_m: [0.5, 0.8, 0.5]}\n");
  ClosedLoopSettings settings = small_sensor();
  settings.known_map = true;
  const ClosedLoopResult result = drive_world(world, power_bot(), settings, 1, nullptr);
  EXPECT_EQ(result.outcome, Outcome::kReached) << result.reason;
  EXPECT_LT(result.travelled_m, 1.1 * result.shortest_m);
}

TEST(ClosedLoop, StopsBeforeAWallWithoutAWayRound) {
  const RandomWorld world = world_of(
      "\n  - wall: {from_m: [2.5, -3], to_m: [2.5, 3], height_m: 1}\n"
      "  - wall: {from_m: [-2, -3], to_m: [2.5, -3], height_m: 1}\n"
      "  - wall: {from_m: [-2, 3], to_m: [2.5, 3], height_m: 1}\n"
      "  - wall: {from_m: [-2, -3], to_m: [-2, 3], height_m: 1}\n");
  const ClosedLoopResult result = drive_world(world, power_bot(), small_sensor(), 1, nullptr);
  EXPECT_EQ(result.outcome, Outcome::kStopped) << result.reason;
  EXPECT_LT(result.end_m.x(), 2.2);
}

TEST(ClosedLoop, SeesThePeopleWhoWalkThroughTheWorld) {
  RandomWorld world = world_of(" []\n");
  ClosedLoopSettings settings = small_sensor();
  settings.most_s = 2;
  const auto blocked = [&] {
    RunRecord record;
    const ClosedLoopResult result = drive_world(world, power_bot(), settings, 1, &record);
    EXPECT_EQ(result.outcome, Outcome::kStopped) << result.reason;
    EXPECT_GT(record.driven_m.size(), 10U);
    int count = 0;
    for (const auto& [index, tile] : record.map.map().tiles())
      count += static_cast<int>(tile->state.count(VertexState::kBlocked));
    return count;
  };
  const int alone = blocked();
  world.scene.people.push_back({{3.0, -0.2}, {3.0, 0.2}, 0.2, 1.75, 0.0});
  EXPECT_GT(blocked(), alone + 5);
}

TEST(ClosedLoop, TheSameSeedDrivesTheSameWay) {
  const RandomWorld world = world_of("\n  - box: {center_m: [2.2, 0.1], size_m: [0.5, 0.8, 0.5]}\n");
  ClosedLoopSettings settings = small_sensor();
  settings.pose_noise = {.position_m = 0.005, .angle_deg = 0.1};
  settings.most_s = 4;
  const ClosedLoopResult a = drive_world(world, power_bot(), settings, 3, nullptr);
  const ClosedLoopResult b = drive_world(world, power_bot(), settings, 3, nullptr);
  EXPECT_EQ(a.end_m, b.end_m);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.travelled_m, b.travelled_m);
}

TEST(RandomWorlds, AreTheSameForASeedAndAlwaysHaveAWay) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const RandomWorld a = random_world(seed, 0.7, 2, power_bot());
    const RandomWorld b = random_world(seed, 0.7, 2, power_bot());
    EXPECT_EQ(*a.scene.goal_m, *b.scene.goal_m);
    EXPECT_EQ(a.scene.fixed.blocks.size(), b.scene.fixed.blocks.size());
    const auto way = shortest_way_m(a.truth, power_bot().radius_m, {0, 0}, *a.scene.goal_m, 0.1);
    ASSERT_TRUE(way);
    EXPECT_GE(*way, (*a.scene.goal_m).norm() - 0.2);
    EXPECT_TRUE(a.truth.at(*a.scene.goal_m)->drivable);
  }
}

TEST(TrueRoute, GoesRoundAWallAtTheRobotsDistance) {
  const RandomWorld world = world_of("\n  - wall: {from_m: [2, -3], to_m: [2, 1], height_m: 1}\n");
  const double way = *shortest_way_m(world.truth, 0.55, {0, 0}, {4, 0}, 0.0);
  // two tangents to the circle of 0.55 m around the wall's end at (2, 1), and the arc between them
  const double apart = std::hypot(2.0, 1.0);
  const double half_arc = M_PI - std::atan2(2.0, 1.0) - std::acos(0.55 / apart);
  const double exact = 2.0 * std::sqrt(apart * apart - 0.55 * 0.55) + 2.0 * 0.55 * half_arc;
  EXPECT_GT(way, 0.99 * exact);
  EXPECT_LT(way, 1.01 * exact + 2.0 * 0.05);  // in 48 directions, over cells of 5 cm
  EXPECT_NEAR(*shortest_way_m(world.truth, 0.55, {0, 0}, {4, 0}, 0.5), way - 0.5, 0.06);
  EXPECT_FALSE(shortest_way_m(world.truth, 2.5, {0, 0}, {4, 0}, 0.0));
}

}  // namespace
}  // namespace floornav
