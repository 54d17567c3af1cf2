#include "planner/planner.hpp"

#include <cmath>
#include <optional>
#include <random>
#include <utility>

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

TEST(Planner, GoesOnFromAFewCentimetresInsideTheInflation) {
  const GridMap map = draw_map(room(100, 60), kCell_m);
  Planner planner({}, robot());
  const Plan plan = planner.plan(map, pose_at(0.38, 3.0), {8, 3, 0.1});  // 0.28 m from the wall
  EXPECT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
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

/// A hall with a pillar in the middle; the ways around it are equal.
std::vector<std::string> hall_with_pillar() {
  auto rows = room(100, 61);
  fill(rows, 45, 20, 55, 41, '#');
  return rows;
}

/// The drawing as a later version of a map.
GridMap redraw(const std::vector<std::string>& rows, std::int64_t version) {
  GridMap map = draw_map(rows, kCell_m);
  map.version = version;
  for (const auto& [index, tile] : map.tiles()) tile->version = version;
  return map;
}

TEST(Planner, KeepsItsWayUntilAnotherIsClearlyBetter) {
  Planner planner({}, robot());
  auto rows = hall_with_pillar();
  const Goal goal{8, 3.05, 0.1};
  const Plan plan = planner.plan(redraw(rows, 1), pose_at(2, 3.05), goal);
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  const auto is_above = [](const Plan& p) {
    double highest = 0;
    for (const PathPoint& point : p.points) highest = std::max(highest, point.y_m);
    return highest > 4.0;
  };
  const bool above = is_above(plan);
  // The other way is better by a little, then by a lot.
  fill(rows, 49, above ? 41 : 19, 50, above ? 42 : 20, '#');
  GridMap map = redraw(rows, 2);
  const Plan fresh = Planner({}, robot()).plan(map, pose_at(2, 3.05), goal);
  ASSERT_NE(is_above(fresh), above) << "the drawing does not make the other way better";
  const Plan kept = planner.plan(map, pose_at(2, 3.05), goal, &plan);
  EXPECT_EQ(is_above(kept), above);
  fill(rows, 49, above ? 41 : 1, 50, above ? 60 : 20, '#');
  map = redraw(rows, 3);
  EXPECT_FALSE(planner.holds(kept, map, pose_at(2, 3.05), goal));
  EXPECT_NE(is_above(planner.plan(map, pose_at(2, 3.05), goal, &kept)), above);
}

TEST(Planner, DoesNotFlipBetweenEqualWaysOnANoisyMap) {
  const auto changes_of_side = [](double keep_path_ratio) {
    PlannerSettings settings;
    settings.keep_path_ratio = keep_path_ratio;
    Planner planner(settings, robot());
    std::mt19937 random(7);
    std::optional<Plan> previous;
    int side = 0, changed = 0;
    for (int version = 1; version <= 60; ++version) {
      auto rows = hall_with_pillar();
      for (int n = 0; n < 3; ++n) rows[random() % 2 == 0 ? 19 : 41][45 + random() % 10] = '#';
      Plan plan = planner.plan(redraw(rows, version), pose_at(2, 3.05), {8, 3.05, 0.1},
                               previous ? &*previous : nullptr);
      double highest_m = 0;
      for (const PathPoint& p : plan.points) highest_m = std::max(highest_m, p.y_m);
      const int now = highest_m > 4.0 ? 1 : -1;
      changed += side != 0 && now != side ? 1 : 0;
      side = now;
      previous = std::move(plan);
    }
    return changed;
  };
  EXPECT_GT(changes_of_side(1.0), 5) << "the noise does not make now one, now the other way better";
  EXPECT_EQ(changes_of_side(PlannerSettings{}.keep_path_ratio), 0);
}

TEST(Planner, NoticesThatTheRobotLeftItsPath) {
  const GridMap map = draw_map(room(100, 60), kCell_m);
  Planner planner({}, robot());
  const Goal goal{8, 3, 0.1};
  const Plan plan = planner.plan(map, pose_at(2, 3), goal);
  EXPECT_TRUE(planner.holds(plan, map, pose_at(3, 3.2), goal));
  EXPECT_FALSE(planner.holds(plan, map, pose_at(3, 3.8), goal));
}

}  // namespace
}  // namespace floornav
