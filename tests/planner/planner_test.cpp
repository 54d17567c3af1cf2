#include "planner/planner.hpp"

#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "map_drawing.hpp"

namespace floornav {
namespace {

constexpr double kCell_m = 0.1;

Pose pose_at(double x_m, double y_m) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
  return pose;
}

RobotSettings robot() {
  RobotSettings settings;
  settings.radius_m = 0.3;
  return settings;
}

/// A room of free floor, `wide` x `high` cells, with walls around it.
std::vector<std::string> room(std::size_t wide, std::size_t high) {
  std::string row(wide, '.');
  row.front() = row.back() = '#';
  std::vector<std::string> rows(high, row);
  rows.front() = rows.back() = std::string(wide, '#');
  return rows;
}

void fill(std::vector<std::string>& rows, std::size_t x0, std::size_t y0, std::size_t x1, std::size_t y1,
          char what) {
  for (std::size_t y = y0; y < y1; ++y)
    for (std::size_t x = x0; x < x1; ++x) rows[y][x] = what;
}

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

/// Highest and lowest speed on a stretch of x.
std::pair<double, double> speeds_between(const Plan& plan, double x0_m, double x1_m) {
  double slowest = 1e9, fastest = 0;
  for (const PathPoint& p : plan.points) {
    if (p.x_m < x0_m || p.x_m > x1_m) continue;
    slowest = std::min(slowest, p.speed_mps);
    fastest = std::max(fastest, p.speed_mps);
  }
  return {slowest, fastest};
}

/// A hall 20 m long whose floor has the given height above x.
template <class Height>
GridMap hall(const Height& height_m, double slope_from_m = 0, double slope_to_m = 0, double slope_deg = 0) {
  constexpr double kFine_m = 0.05;
  GridMap map = draw_map(std::vector<std::string>(80, std::string(400, '.')), kFine_m);
  for (std::int32_t iy = 0; iy < 80; ++iy)
    for (std::int32_t ix = 0; ix < 400; ++ix) {
      const double x_m = map.lattice().center_of(ix);
      GridTile& tile = *map.find(GridMap::tile_of({ix, iy}));
      const auto i = static_cast<std::size_t>(GridTile::index_of({ix, iy}));
      tile.height[i] = static_cast<std::int16_t>(std::lround(height_m(x_m) / 1e-4));
      if (x_m > slope_from_m && x_m < slope_to_m) tile.slope[i] = static_cast<std::uint8_t>(2 * slope_deg);
    }
  return map;
}

TEST(PlannedSpeed, FallsBeforeARampAndRisesBehindIt) {
  const double rise = std::tan(8.0 * 3.14159265 / 180);
  const GridMap map = hall([&](double x) { return rise * std::clamp(x - 8.0, 0.0, 2.0); }, 8.0, 10.0, 8.0);
  const RobotSettings powerbot = robot();
  const Plan plan = Planner({}, powerbot).plan(map, pose_at(1, 2), {19, 2, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_DOUBLE_EQ(speeds_between(plan, 2, 6).second, powerbot.max_speed_mps);
  const double on_ramp_mps = speeds_between(plan, 8.2, 9.8).second;
  EXPECT_LT(on_ramp_mps, 0.5 * powerbot.max_speed_mps);
  // Slow when it gets there, by the robot's acceleration, and not for the whole way before.
  EXPECT_LT(speeds_between(plan, 7.85, 8.1).first, on_ramp_mps + 0.25);
  EXPECT_DOUBLE_EQ(speeds_between(plan, 12, 16).second, powerbot.max_speed_mps);
  for (std::size_t i = 1; i < plan.points.size(); ++i) {
    const double a = plan.points[i - 1].speed_mps, b = plan.points[i].speed_mps;
    const double ds_m = plan.points[i].x_m - plan.points[i - 1].x_m;
    EXPECT_LE(std::abs(b * b - a * a), 2 * powerbot.max_acceleration_mps2 * ds_m + 1e-9);
  }
}

TEST(PlannedSpeed, CrawlsOverAJoinOfOneCentimetreAndNotOverOneOfTwoMillimetres) {
  PlannerSettings settings;
  const auto join = [](double height_m) { return hall([=](double x) { return x > 10.0 ? height_m : 0.0; }); };
  const Plan slow = Planner(settings, robot()).plan(join(0.01), pose_at(1, 2), {19, 2, 0.1});
  ASSERT_EQ(slow.status, PlanStatus::kFollowing) << slow.reason;
  EXPECT_LE(speeds_between(slow, 9.9, 10.1).second, settings.creep_speed_mps + 0.01);
  EXPECT_DOUBLE_EQ(speeds_between(slow, 4, 7).second, robot().max_speed_mps);
  const Plan fast = Planner(settings, robot()).plan(join(0.002), pose_at(1, 2), {19, 2, 0.1});
  EXPECT_GT(speeds_between(fast, 9.5, 10.5).first, 0.9 * robot().max_speed_mps);
}

TEST(PlannedSpeed, LetsTheRobotStopBeforeTheUnknown) {
  auto rows = room(200, 60);
  fill(rows, 120, 0, 200, 60, ' ');
  const RobotSettings bot = robot();
  const Plan plan = Planner({}, bot).plan(draw_map(rows, kCell_m), pose_at(2, 3), {18, 3, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFrontier);
  for (const PathPoint& p : plan.points) {
    const double stopping_m = p.speed_mps * p.speed_mps / (2 * bot.max_acceleration_mps2);
    EXPECT_LE(p.x_m + stopping_m + bot.radius_m, 12.0 + 1e-9);
  }
  EXPECT_DOUBLE_EQ(speeds_between(plan, 4, 9).second, bot.max_speed_mps);
}

TEST(PlannedPath, RoundsItsCornersWhereThereIsRoom) {
  auto rows = room(100, 100);
  fill(rows, 40, 0, 60, 60, '#');
  const RobotSettings bot = robot();
  const Plan plan = Planner({}, bot).plan(draw_map(rows, kCell_m), pose_at(2, 2), {8, 2, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  for (std::size_t i = 1; i + 1 < plan.points.size(); ++i) {
    const double turn_rad =
        std::abs(std::remainder(plan.points[i].heading_rad - plan.points[i - 1].heading_rad, 2 * 3.14159265));
    EXPECT_LT(turn_rad, 0.4) << "at point " << i;
    const double arc_m =
        std::hypot(plan.points[i].x_m - plan.points[i - 1].x_m, plan.points[i].y_m - plan.points[i - 1].y_m);
    // Never faster than the robot turns, over a spacing of the points.
    EXPECT_LE(plan.points[i].speed_mps * turn_rad, bot.max_turn_rate_radps * std::max(arc_m, 0.1) + 1e-9);
  }
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
