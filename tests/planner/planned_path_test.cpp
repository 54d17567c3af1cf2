#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "drawn_rooms.hpp"
#include "planner/planner.hpp"

namespace floornav {
namespace {

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

}  // namespace
}  // namespace floornav
