#include "planner/taut_way.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "drawn_rooms.hpp"
#include "planner/planner.hpp"
#include "planner/route.hpp"

namespace floornav {
namespace {

/// Lengths count, nothing else.
PlannerSettings shortest() {
  PlannerSettings settings;
  settings.clearance_cost = settings.turn_cost = 0;
  return settings;
}

/// Of the shortest way of a circle around a place that it keeps `radius_m` from: two tangents and an arc.
double around(double x0_m, double y0_m, double x1_m, double y1_m, double radius_m) {
  const double a = std::hypot(x0_m, y0_m), b = std::hypot(x1_m, y1_m);
  const double between_rad = std::acos((x0_m * x1_m + y0_m * y1_m) / (a * b));
  const double arc_rad = between_rad - std::acos(radius_m / a) - std::acos(radius_m / b);
  return std::sqrt(a * a - radius_m * radius_m) + std::sqrt(b * b - radius_m * radius_m) + radius_m * arc_rad;
}

class TautWayFrom : public testing::TestWithParam<int> {};

TEST_P(TautWayFrom, IsAsShortAsTheTangentsAroundAPost) {
  auto rows = room(120, 120);
  rows[60][60] = '#';  // its middle at (6.05, 6.05)
  const GridMap map = draw_map(rows, kCell_m);
  const double angle_rad = GetParam() * std::numbers::pi / 24;
  const auto at = [](double rad) { return Eigen::Vector2d(5.0 * std::cos(rad), 5.0 * std::sin(rad)); };
  const Eigen::Vector2d from = at(angle_rad), to = at(angle_rad + 3.1);
  const Plan plan =
      Planner(shortest(), robot())
          .plan(map, pose_at(6.05 + from.x(), 6.05 + from.y()), {6.05 + to.x(), 6.05 + to.y(), 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_GE(plan.length_m, around(from.x(), from.y(), to.x(), to.y(), 0.3));
  // The circle keeps off the post's corners, its middle on cells, and the way round the other side is as
  // long.
  EXPECT_LE(plan.length_m, 1.01 * around(from.x(), from.y(), to.x(), to.y(), 0.3));
}

INSTANTIATE_TEST_SUITE_P(Angles, TautWayFrom, testing::Range(0, 12));

double turned_rad(const std::vector<GridPoint>& corners, double heading_rad) {
  double sum = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double next_rad = heading_between(corners[i - 1], corners[i]);
    sum += std::abs(std::remainder(next_rad - heading_rad, 2 * std::numbers::pi));
    heading_rad = next_rad;
  }
  return sum;
}

double length(const std::vector<GridPoint>& corners) {
  double sum = 0;
  for (std::size_t i = 1; i < corners.size(); ++i)
    sum += std::hypot(corners[i].x - corners[i - 1].x, corners[i].y - corners[i - 1].y);
  return sum;
}

TEST(TautWay, CountsTurns) {
  auto rows = room(120, 60);
  fill(rows, 40, 0, 42, 30, '#');
  fill(rows, 70, 30, 72, 60, '#');
  PlanningGrid grid(shortest(), robot());
  grid.update(draw_map(rows, kCell_m), {0, 0, 120, 60}, {});
  const GridCell origin{-grid.origin().ix, -grid.origin().iy};
  const auto point = [&](int x, int y) { return centre({origin.x + x, origin.y + y}); };
  const std::vector<GridPoint> zigzag{point(10, 10), point(30, 35), point(50, 45),
                                      point(65, 20), point(85, 20), point(110, 50)};
  const double heading_rad = -1.0;
  const auto cheap = pulled_taut(grid, zigzag, heading_rad, 0.0);
  const auto dear = pulled_taut(grid, zigzag, heading_rad, 20.0);
  EXPECT_LT(length(cheap), length(zigzag));
  EXPECT_LT(length(cheap), length(dear));  // dear lines are worth it where a turn costs more
  const auto cost = [&](const std::vector<GridPoint>& way) {
    return length(way) + 20.0 * turned_rad(way, heading_rad);
  };
  EXPECT_LT(cost(dear), cost(zigzag));
}

}  // namespace
}  // namespace floornav
