#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "drawn_rooms.hpp"
#include "planner/planner.hpp"

namespace floornav {
namespace {

TEST(Planner, StartsOnAssumedFloorAndMarksIt) {
  auto rows = room(100, 60);
  fill(rows, 0, 20, 25, 40, ' ');
  const GridMap map = draw_map(rows, kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(2, 3), {8, 3, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_TRUE(plan.points.front().assumed);
  EXPECT_FALSE(plan.points.back().assumed);
}

TEST(Planner, AssumesNothingAboutPlacesWhereItStandsLater) {
  const GridMap empty(kCell_m);
  Planner planner({}, robot());
  EXPECT_EQ(planner.plan(empty, pose_at(0, 0), {5, 0, 0.1}).status, PlanStatus::kFrontier);
  const Plan elsewhere = planner.plan(empty, pose_at(3, 0), {8, 0, 0.1});
  EXPECT_EQ(elsewhere.status, PlanStatus::kFrontier);
  EXPECT_TRUE(elsewhere.points.empty());
}

TEST(Planner, AssumesFloorAgainWhenTheMapStartsANewEpoch) {
  GridMap empty(kCell_m);
  Planner planner({}, robot());
  planner.plan(empty, pose_at(0, 0), {5, 0, 0.1});
  empty.epoch = 1;
  EXPECT_FALSE(planner.plan(empty, pose_at(3, 0), {8, 0, 0.1}).points.empty());
}

TEST(Planner, SaysThatTheStartIsBlockedAndByHowMuch) {
  auto rows = room(100, 60);
  fill(rows, 18, 10, 20, 40, '#');  // between two walls, as near to one as to the other
  fill(rows, 21, 10, 23, 40, '#');
  const GridMap map = draw_map(rows, kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(2.05, 2.05), {8, 3, 0.1});
  EXPECT_EQ(plan.status, PlanStatus::kStartBlocked);
  EXPECT_NE(plan.reason.find("0.05 m"), std::string::npos) << plan.reason;
  EXPECT_TRUE(plan.points.empty());
}

TEST(Planner, SaysThatTheStartIsBlockedWhereTheMapHasAnObstacleUnderTheRobot) {
  auto rows = room(100, 60);
  rows[20][20] = '#';
  Planner planner({}, robot());
  EXPECT_EQ(planner.plan(draw_map(rows, kCell_m), pose_at(2.05, 2.05), {8, 3, 0.1}).status,
            PlanStatus::kStartBlocked);
}

TEST(Planner, CreepsOutOfTheInflationAwayFromWhatIsTooNear) {
  auto rows = room(100, 60);
  fill(rows, 21, 19, 23, 22, '#');
  const GridMap map = draw_map(rows, kCell_m);
  PlannerSettings settings;
  Planner planner(settings, robot());
  const Plan plan = planner.plan(map, pose_at(2.05, 2.05), {8, 3, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_DOUBLE_EQ(plan.points.front().x_m, 2.05);
  bool out = false;
  double nearest_m = 0.05;  // to the obstacle, from where it stands
  for (const PathPoint& p : plan.points) {
    const double dx = std::max({2.1 - p.x_m, p.x_m - 2.3, 0.0}),
                 dy = std::max({1.9 - p.y_m, p.y_m - 2.2, 0.0});
    const double here_m = std::hypot(dx, dy);
    out = out || here_m >= 0.3;
    if (out) {
      EXPECT_GE(here_m, 0.3);
      continue;
    }
    EXPECT_GE(here_m, nearest_m - 1e-9);
    EXPECT_LE(p.speed_mps, settings.creep_speed_mps);
    nearest_m = here_m;
  }
  EXPECT_TRUE(out);
  EXPECT_TRUE(planner.holds(plan, map, pose_at(2.05, 2.05), {8, 3, 0.1}));
}

TEST(Planner, SetsOutFromAPlaceNeverSeenUnderTheRobot) {
  auto rows = room(100, 60);
  fill(rows, 38, 28, 43, 33, ' ');
  const GridMap map = draw_map(rows, kCell_m);
  PlannerSettings settings;
  settings.assumed_radius_m = 0.0;
  Planner planner(settings, robot());
  ASSERT_EQ(planner.plan(map, pose_at(2, 3), {8, 3, 0.1}).status, PlanStatus::kFollowing);
  const Plan plan = planner.plan(map, pose_at(4.05, 3.05), {8, 3, 0.1});
  EXPECT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
}

TEST(Planner, GoesOnFromAFewCentimetresInsideTheInflation) {
  const GridMap map = draw_map(room(100, 60), kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(0.38, 3.0), {8, 3, 0.1});  // 0.28 m from the wall
  EXPECT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
}

/// A robot drives towards a wall with a gap ahead of it, when the gap turns out to be shut; another one is
/// far to its left.
std::vector<std::string> two_gaps(bool ahead_open) {
  auto rows = room(100, 80);
  fill(rows, 60, 0, 62, 80, '#');
  fill(rows, 60, 60, 62, 72, '.');
  if (ahead_open) fill(rows, 60, 15, 62, 27, '.');
  return rows;
}

TEST(Departure, LeavesThePathNoSoonerThanTheRobotCanStop) {
  Planner planner({}, robot());
  const Goal goal{8, 2.05, 0.1};
  const Plan before = planner.plan(draw_map(two_gaps(true), kCell_m), pose_at(2, 2.05), goal);
  ASSERT_NEAR(before.length_m, 6.0, 0.05);
  GridMap shut = draw_map(two_gaps(false), kCell_m);
  shut.version = 2;
  for (const auto& [index, tile] : shut.tiles()) tile->version = 2;
  // 1 m/s: 1 m of braking at 0.5 m/s2 and 0.2 m until it begins
  const Plan moving = planner.plan(shut, pose_at(3, 2.05), goal, &before, {}, 1.0);
  ASSERT_EQ(moving.status, PlanStatus::kFollowing) << moving.reason;
  double straight_m = 0;
  for (const PathPoint& p : moving.points) {
    if (std::abs(p.y_m - 2.05) > 0.02) break;
    straight_m = p.x_m - 3.0;
  }
  EXPECT_GT(straight_m, 0.7);  // the corner is rounded
  EXPECT_LT(straight_m, 1.3);
  const Plan at_rest = planner.plan(shut, pose_at(3, 2.05), goal, &before);
  EXPECT_GT(at_rest.points[6].y_m, 2.3);
  EXPECT_LT(at_rest.length_m, moving.length_m - 0.3);
}

TEST(Departure, LeavesThePathAtOnceWhereItIsShutAlready) {
  Planner planner({}, robot());
  const Goal goal{8, 2.05, 0.1};
  const Plan before = planner.plan(draw_map(two_gaps(true), kCell_m), pose_at(2, 2.05), goal);
  auto rows = two_gaps(false);
  fill(rows, 40, 15, 42, 27, '#');
  GridMap shut = draw_map(rows, kCell_m);
  shut.version = 2;
  for (const auto& [index, tile] : shut.tiles()) tile->version = 2;
  const Plan plan = planner.plan(shut, pose_at(3, 2.05), goal, &before, {}, 1.0);
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  for (const PathPoint& p : plan.points) EXPECT_GE(p.clearance_m, 0.3);
  EXPECT_GT(plan.points[6].y_m, 2.3);
}

TEST(Departure, LeavesTheWayToAnotherGoalNoSoonerEither) {
  const GridMap map = draw_map(room(100, 80), kCell_m);
  Planner planner({}, robot());
  const Plan before = planner.plan(map, pose_at(2, 2.05), {8, 2.05, 0.1});
  const Plan plan = planner.plan(map, pose_at(3, 2.05), {3, 7, 0.1}, &before, {}, 1.0);
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_NEAR(plan.points.back().y_m, 7.0, 0.1);
  EXPECT_LT(plan.points[5].y_m, 2.15);
}

}  // namespace
}  // namespace floornav
