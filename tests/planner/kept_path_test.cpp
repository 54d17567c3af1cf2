#include <algorithm>
#include <optional>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "drawn_rooms.hpp"
#include "planner/planner.hpp"

namespace floornav {
namespace {

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
    settings.comfort_m = 3 * kCell_m;  // as many cells as on a mapper's map: the noise does not shut the way
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
