#include "planner/planner.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "drawn_rooms.hpp"

namespace floornav {
namespace {

TEST(Planner, GoesStraightAcrossAnEmptyRoom) {
  const GridMap map = draw_map(room(100, 60), kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(1.23, 2.02), {8.76, 4.44, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_NEAR(plan.length_m, std::hypot(7.53, 2.42), 1e-9);
  EXPECT_DOUBLE_EQ(plan.points.front().x_m, 1.23);
  EXPECT_DOUBLE_EQ(plan.points.back().y_m, 4.44);
  EXPECT_NEAR(plan.points[5].heading_rad, std::atan2(2.42, 7.53), 1e-9);
  EXPECT_EQ(plan.map_version, 1);
}

TEST(Planner, GoesAroundAWallWithRoomToSpare) {
  auto rows = room(100, 60);
  fill(rows, 50, 0, 52, 40, '#');
  const GridMap map = draw_map(rows, kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(2, 2), {8, 2, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  // The shortest way for a circle of 0.3 m is two tangents to the wall's end and an arc; the path keeps
  // further off.
  EXPECT_GT(plan.length_m, 2 * std::hypot(3.0, 2.3));
  EXPECT_LT(plan.length_m, 2 * std::hypot(3.0, 2.6) + 0.6);
  for (const PathPoint& p : plan.points) EXPECT_GE(p.clearance_m, 0.3);
}

TEST(Planner, StopsBeforeTheUnknownAndSaysFrontier) {
  auto rows = room(100, 60);
  fill(rows, 40, 0, 100, 60, ' ');
  const GridMap map = draw_map(rows, kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(2, 3), {8, 3, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFrontier);
  EXPECT_FALSE(plan.reason.empty());
  EXPECT_LE(plan.points.back().x_m, 4.0 - 0.3);
  EXPECT_GT(plan.points.back().x_m, 4.0 - 0.3 - 2 * kCell_m);
  EXPECT_EQ(plan.points.back().speed_mps, 0.0);
}

TEST(Planner, PrefersKnownFloorToAShortWayThroughTheUnknown) {
  auto rows = room(100, 60);
  fill(rows, 40, 0, 60, 40, ' ');
  const GridMap map = draw_map(rows, kCell_m);
  Planner planner({}, robot());
  EXPECT_EQ(planner.plan(map, pose_at(2, 3), {8, 3, 0.1}).status, PlanStatus::kFollowing);
}

TEST(Planner, KeepsItsWheelsOffStepsThatItsCentrePasses) {
  GridMap map = draw_map(room(100, 60), kCell_m);
  for (std::int32_t x = 30; x < 70; ++x)  // a kerb along y = 3.2, beside the straight way
    for (const unsigned k : {1U, 2U, 3U}) close_edge(map, {x, 31}, k);
  RobotSettings narrow = robot();
  narrow.track_m = 0.5;
  const Plan plan = Planner({}, narrow).plan(map, pose_at(1, 3.05), {9, 3.05, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  for (const PathPoint& p : plan.points) {
    const double along_m = std::max({3.0 - p.x_m, p.x_m - 7.0, 0.0});
    EXPECT_GE(std::hypot(along_m, 3.2 - p.y_m), 0.25);
  }
}

TEST(Planner, TakesTheNearestReachablePlaceWithinTheTolerance) {
  auto rows = room(100, 60);
  fill(rows, 78, 28, 83, 33, '#');  // the goal is inside
  const GridMap map = draw_map(rows, kCell_m);
  Planner planner({}, robot());
  EXPECT_EQ(planner.plan(map, pose_at(2, 3), {8.05, 3.05, 0.3}).status, PlanStatus::kGoalBlocked);
  const Plan plan = planner.plan(map, pose_at(2, 3), {8.05, 3.05, 1.0});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  const double off_m = std::hypot(plan.points.back().x_m - 8.05, plan.points.back().y_m - 3.05);
  EXPECT_GT(off_m, 0.25 + 0.3);
  EXPECT_LT(off_m, 0.25 + 0.3 + 2 * kCell_m);
}

TEST(Planner, TakesAReachablePlaceRatherThanANearerOneBehindAWall) {
  auto rows = room(100, 60);
  fill(rows, 70, 0, 72, 60, '#');
  const GridMap map = draw_map(rows, kCell_m);
  Planner planner({}, robot());
  EXPECT_EQ(planner.plan(map, pose_at(2, 3), {7.6, 3.05, 0.2}).status, PlanStatus::kNoPath);
  const Plan plan = planner.plan(map, pose_at(2, 3), {7.6, 3.05, 1.2});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_LT(plan.points.back().x_m, 7.0 - 0.3);
}

TEST(Planner, DrivesAroundAStepThatTheMapCloses) {
  GridMap map = draw_map(room(60, 60), kCell_m);
  for (std::int32_t y = 1; y < 40; ++y)
    for (const unsigned k : {7U, 0U, 1U}) close_edge(map, {30, y}, k);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(2, 2), {4.5, 2, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_GT(plan.length_m, 4.0);
}

TEST(Planner, SaysReachedWithinTheTolerance) {
  const GridMap map = draw_map(room(100, 60), kCell_m);
  Planner planner({}, robot());
  EXPECT_EQ(planner.plan(map, pose_at(2, 3), {2.4, 3, 0.5}).status, PlanStatus::kReached);
  EXPECT_EQ(planner.plan(map, pose_at(2, 3), {2.1, 3, 0.0}).status, PlanStatus::kReached);
}

TEST(Planner, ComesToRestWithinTheToleranceBeforeItSaysReached) {
  const GridMap map = draw_map(room(100, 60), kCell_m);
  Planner planner({}, robot());
  const Goal goal{8, 3, 3.0};
  const Plan before = planner.plan(map, pose_at(2, 3), goal);
  const Plan braking = planner.plan(map, pose_at(5.1, 3), goal, &before, {}, 1.0);
  ASSERT_EQ(braking.status, PlanStatus::kFollowing) << braking.reason;
  EXPECT_NEAR(braking.length_m, 1.2, 0.15);  // 0.2 s, and 1 m at 0.5 m/s2
  EXPECT_EQ(braking.points.back().speed_mps, 0.0);
  EXPECT_EQ(planner.plan(map, pose_at(6.1, 3), goal, &braking, {}, 0.05).status, PlanStatus::kReached);
}

TEST(Planner, RefusesAGoalTooFarAway) {
  const GridMap map = draw_map(room(100, 60), kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(2, 3), {1e6, 3, 0.5});
  EXPECT_EQ(plan.status, PlanStatus::kNoPath);
  EXPECT_NE(plan.reason.find("max_distance_m"), std::string::npos);
}

TEST(Planner, TakesTheShortestWayWhenThereIsNoTimeForTheCheapest) {
  auto walled = room(300, 300);
  fill(walled, 200, 0, 202, 290, '#');
  Planner planner({}, robot());
  const Plan plan =
      planner.plan(draw_map(walled, kCell_m), pose_at(2, 3), {28, 3, 0.5}, nullptr, [] { return true; });
  EXPECT_EQ(plan.status, PlanStatus::kFollowing);
  EXPECT_NE(plan.reason.find("shortest"), std::string::npos) << plan.reason;
  EXPECT_GT(plan.length_m, 2 * 25.0);
}

TEST(Planner, GivesUpWhenToldTo) {
  auto walled = room(300, 300);
  fill(walled, 200, 0, 202, 300, '#');
  Planner planner({}, robot());
  const Plan plan =
      planner.plan(draw_map(walled, kCell_m), pose_at(2, 3), {28, 3, 0.5}, nullptr, [] { return true; });
  EXPECT_EQ(plan.status, PlanStatus::kInterrupted);
}

TEST(Planner, FindsTheShortestWayByJumpPointsWhereNothingCostsMoreThanItsLength) {
  auto rows = room(300, 200);
  fill(rows, 100, 0, 102, 150, '#');
  fill(rows, 200, 50, 202, 200, '#');
  const GridMap map = draw_map(rows, kCell_m);
  PlannerSettings uniform;
  uniform.unknown_cost = uniform.belief_cost = uniform.slope_cost = uniform.clearance_cost = 0;
  const Plan plan = Planner(uniform, robot()).plan(map, pose_at(2, 2), {28, 2, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  const Plan cautious = Planner({}, robot()).plan(map, pose_at(2, 2), {28, 2, 0.1});
  EXPECT_LE(plan.length_m, 1.02 * cautious.length_m);
  EXPECT_GT(plan.length_m, 30.0);
}

}  // namespace
}  // namespace floornav
