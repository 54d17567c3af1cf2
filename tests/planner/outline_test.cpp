#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "map_drawing.hpp"
#include "planner/outline_search.hpp"
#include "planner/planner.hpp"
#include "planner/robot_outline.hpp"

namespace floornav {
namespace {

constexpr double kCell_m = 0.05;

/// A robot 1.0 m x 0.5 m, that turns about a point 0.1 m behind its middle.
RobotSettings long_robot() {
  RobotSettings robot;
  robot.footprint = {{0.6, 0.25}, {-0.4, 0.25}, {-0.4, -0.25}, {0.6, -0.25}};
  robot.footprint_margin_m = 0.0;
  robot.radius_m = 0.66;
  robot.track_m = 0.3;
  return robot;
}

Pose pose_at(double x_m, double y_m, double heading_rad) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
  pose.linear() = Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

struct Point {
  double x, y;
};

std::vector<Point> outline_at(const RobotSettings& robot, double x_m, double y_m, double heading_rad,
                              double larger_m = 0) {
  std::vector<Point> corners;
  for (const FootprintCorner& c : robot.footprint) {
    const double bx = c.x_m + std::copysign(larger_m, c.x_m), by = c.y_m + std::copysign(larger_m, c.y_m);
    corners.push_back({x_m + std::cos(heading_rad) * bx - std::sin(heading_rad) * by,
                       y_m + std::sin(heading_rad) * bx + std::cos(heading_rad) * by});
  }
  return corners;
}

/// Whether an axis parts two convex areas; the axes to try are the normals of all sides.
bool overlap(const std::vector<Point>& a, const std::vector<Point>& b) {
  for (const auto* area : {&a, &b}) {
    for (std::size_t i = 0; i < area->size(); ++i) {
      const Point p = (*area)[i], q = (*area)[(i + 1) % area->size()];
      const Point axis{q.y - p.y, p.x - q.x};
      const auto range = [&](const std::vector<Point>& points) {
        double low = 1e300, high = -1e300;
        for (const Point& r : points) {
          low = std::min(low, axis.x * r.x + axis.y * r.y);
          high = std::max(high, axis.x * r.x + axis.y * r.y);
        }
        return std::pair(low, high);
      };
      const auto [low_a, high_a] = range(a);
      const auto [low_b, high_b] = range(b);
      const double touch = 1e-6 * std::hypot(axis.x, axis.y);
      if (high_a <= low_b + touch || high_b <= low_a + touch) return false;
    }
  }
  return true;
}

/// The first state, other than free, of a cell that the outline overlaps; kFree where there is none.
VertexState under(const GridMap& map, const std::vector<Point>& outline) {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (const Point& p : outline)
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  const double side_m = map.lattice().pitch_m;
  const CellIndex low = map.lattice().cell_of(x0, y0), high = map.lattice().cell_of(x1, y1);
  for (std::int32_t iy = low.iy; iy <= high.iy; ++iy)
    for (std::int32_t ix = low.ix; ix <= high.ix; ++ix) {
      if (map.state({ix, iy}) == VertexState::kFree) continue;
      const double x = ix * side_m, y = iy * side_m;
      if (overlap(outline, {{x, y}, {x + side_m, y}, {x + side_m, y + side_m}, {x, y + side_m}}))
        return map.state({ix, iy});
    }
  return VertexState::kFree;
}

/// Drives along the points, turning in place at each the short way; what the outline first overlaps.
std::string fault_on_the_way(const GridMap& map, const RobotSettings& robot, const Plan& plan,
                             double heading_rad) {
  const auto fault_at = [&](double x, double y, double heading) -> std::string {
    const VertexState state = under(map, outline_at(robot, x, y, heading));
    if (state == VertexState::kFree) return "";
    return std::string(state == VertexState::kBlocked ? "blocked" : "unknown") + " at " + std::to_string(x) +
           ", " + std::to_string(y) + " heading for " + std::to_string(heading);
  };
  for (std::size_t i = 1; i < plan.points.size(); ++i) {
    const PathPoint &a = plan.points[i - 1], &b = plan.points[i];
    const double next_rad = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
    const double turn_rad = std::remainder(next_rad - heading_rad, 2 * std::numbers::pi);
    for (double t = 0; t <= 1; t += 0.02)
      if (auto fault = fault_at(a.x_m, a.y_m, heading_rad + t * turn_rad); !fault.empty())
        return "turning: " + fault;
    for (double t = 0; t <= 1; t += 0.1)
      if (auto fault = fault_at(a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m), next_rad);
          !fault.empty())
        return "driving: " + fault;
    heading_rad = next_rad;
  }
  return "";
}

/// Two rooms, 5 m x 4 m each, and a wall 0.4 m thick with a door between them.
GridMap rooms_with_door(std::int32_t door_cells) {
  std::vector<std::string> rows(80, "#" + std::string(198, '.') + "#");
  rows.front() = rows.back() = std::string(200, '#');
  for (std::size_t y = 0; y < rows.size(); ++y)
    if (y < 40 || y >= 40 + static_cast<std::size_t>(door_cells))
      for (std::size_t x = 100; x < 108; ++x) rows[y][x] = '#';
  return draw_map(rows, kCell_m);
}

TEST(RobotOutline, PassesADoorThatItsCircleDoesNot) {
  const GridMap map = rooms_with_door(13);  // 0.65 m
  const RobotSettings robot = long_robot();
  RobotSettings circle = robot;
  circle.footprint.clear();
  EXPECT_EQ(Planner({}, circle).plan(map, pose_at(2, 2, 0), {8, 2, 0.1}).status, PlanStatus::kNoPath);
  const Plan plan = Planner({}, robot).plan(map, pose_at(2, 2, 0), {8, 2, 0.1});
  ASSERT_EQ(plan.status, PlanStatus::kFollowing) << plan.reason;
  EXPECT_EQ(fault_on_the_way(map, robot, plan, 0), "");
  for (const PathPoint& p : plan.points) {
    if (p.x_m < 5.0 || p.x_m > 5.4) continue;
    EXPECT_LT(p.speed_mps, 0.5 * robot.max_speed_mps) << "slow in the door";
  }
  EXPECT_EQ(Planner({}, robot).plan(rooms_with_door(9), pose_at(2, 2, 0), {8, 2, 0.1}).status,
            PlanStatus::kNoPath)
      << "0.45 m is too narrow";
}

TEST(RobotOutline, KeepsItsMarginFree) {
  RobotSettings robot = long_robot();
  robot.footprint_margin_m = 0.06;
  robot.radius_m = 0.75;
  EXPECT_EQ(Planner({}, robot).plan(rooms_with_door(12), pose_at(2, 2, 0), {8, 2, 0.1}).status,
            PlanStatus::kNoPath);
  EXPECT_EQ(Planner({}, robot).plan(rooms_with_door(15), pose_at(2, 2, 0), {8, 2, 0.1}).status,
            PlanStatus::kFollowing);
}

TEST(RobotOutline, SaysSoWhereItCannotTurn) {
  // A dead end 0.7 m wide; the robot looks at its closed end.
  std::vector<std::string> rows(80, "#" + std::string(118, '.') + "#");
  rows.front() = rows.back() = std::string(120, '#');
  for (std::size_t y = 0; y < rows.size(); ++y)
    if (y < 33 || y >= 47)
      for (std::size_t x = 0; x < 60; ++x) rows[y][x] = '#';
  const GridMap map = draw_map(rows, kCell_m);
  const RobotSettings robot = long_robot();
  const Goal goal{5, 2, 0.1};
  const Plan facing_out = Planner({}, robot).plan(map, pose_at(1.0, 2.0, 0), goal);
  EXPECT_EQ(facing_out.status, PlanStatus::kFollowing) << facing_out.reason;
  const Plan facing_in = Planner({}, robot).plan(map, pose_at(1.0, 2.0, std::numbers::pi), goal);
  EXPECT_EQ(facing_in.status, PlanStatus::kNoPath);
  EXPECT_TRUE(facing_in.points.empty());
  const Plan at_the_end = Planner({}, robot).plan(map, pose_at(0.67, 2.0, std::numbers::pi), goal);
  EXPECT_EQ(at_the_end.status, PlanStatus::kStartBlocked) << "nose at the wall";
}

TEST(RobotOutline, RefusesOutlinesThatAreNone) {
  const auto with = [](std::vector<FootprintCorner> corners) {
    RobotSettings robot = long_robot();
    robot.footprint = std::move(corners);
    return robot;
  };
  EXPECT_THROW(Planner({}, with({{0.1, 0.1}, {0.2, 0.2}})), std::invalid_argument);
  EXPECT_THROW(Planner({}, with({{0.1, 0.1}, {0.3, 0.1}, {0.2, 0.3}})), std::invalid_argument) << "origin";
  EXPECT_THROW(Planner({}, with({{0.7, 0}, {-0.2, 0.2}, {-0.2, -0.2}})), std::invalid_argument) << "radius";
  EXPECT_NO_THROW(Planner({}, with({{0.3, 0}, {-0.2, 0.2}, {0, 0}, {-0.2, -0.2}})));
}

struct Problem {
  GridMap map;
  RobotSettings robot;
  double x_m, y_m, heading_rad;
  Goal goal;
};

Problem random_problem(unsigned seed, std::int32_t half_side) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const double pitch_m = seed % 2 == 0 ? 0.05 : 0.1;
  Problem p{random_map(random, half_side, pitch_m, seed % 3 == 0), {}, 0, 0, uniform(-3.1, 3.1), {}};
  const double front = pitch_m * uniform(3, 8), back = pitch_m * uniform(1.5, 4),
               side = pitch_m * uniform(1.5, 4);
  p.robot.footprint = {{front, side}, {-back, side}, {-back, -side}, {front, -side}};
  p.robot.footprint_margin_m = 0;
  p.robot.radius_m = std::hypot(std::max(front, back), side);
  p.robot.track_m = 2 * side;
  const double half_m = (half_side - 6) * pitch_m;
  p.x_m = p.map.lattice().center_of(p.map.lattice().index_of(uniform(-half_m, half_m)));
  p.y_m = p.map.lattice().center_of(p.map.lattice().index_of(uniform(-half_m, half_m)));
  p.goal = {uniform(-half_m, half_m), uniform(-half_m, half_m), 2 * pitch_m};
  return p;
}

class FootprintOfSeed : public testing::TestWithParam<unsigned> {};

TEST_P(FootprintOfSeed, OverlapsNothingBlockedOrUnknownOnAnyPath) {
  int followed = 0;
  for (unsigned seed = 20 * GetParam(); seed < 20 * GetParam() + 20; ++seed) {
    Problem p = random_problem(seed, 40);
    PlannerSettings settings;
    settings.assumed_radius_m = 0;
    if (under(p.map, outline_at(p.robot, p.x_m, p.y_m, p.heading_rad)) != VertexState::kFree) continue;
    GridMap& map = p.map;
    const Plan plan = Planner(settings, p.robot).plan(map, pose_at(p.x_m, p.y_m, p.heading_rad), p.goal);
    if (plan.points.empty() || plan.way_out_points > 0) continue;
    ++followed;
    // What was never seen under the robot is taken for floor.
    const double reach_m = p.robot.radius_m + 2 * map.lattice().pitch_m;
    for (std::int32_t iy = -60; iy < 60; ++iy)
      for (std::int32_t ix = -60; ix < 60; ++ix)
        if (map.state({ix, iy}) == VertexState::kUnknown &&
            std::hypot(map.lattice().center_of(ix) - p.x_m, map.lattice().center_of(iy) - p.y_m) <= reach_m)
          set_cell(map, {ix, iy}, VertexState::kFree);
    ASSERT_EQ(fault_on_the_way(map, p.robot, plan, p.heading_rad), "") << "seed " << seed;
  }
  EXPECT_GT(followed, 2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FootprintOfSeed, testing::Range(0U, 8U));

/// Cells that a robot a little larger can reach by steps and eighths of a turn, the outline looked at in
/// between: by brute force.
bool reachable(const Problem& p, double larger_m) {
  const Lattice& lattice = p.map.lattice();
  const auto free = [&](double x, double y, double heading) {
    return under(p.map, outline_at(p.robot, x, y, heading, larger_m)) == VertexState::kFree;
  };
  const auto may_turn = [&](CellIndex c, double from, double to) {
    const double turn = std::remainder(to - from, 2 * std::numbers::pi);
    for (double t = 0; t <= 1; t += 0.1)
      if (!free(lattice.center_of(c.ix), lattice.center_of(c.iy), from + t * turn)) return false;
    return true;
  };
  const auto may_step = [&](CellIndex c, unsigned k) {
    for (double t = 0; t <= 1; t += 0.25)
      if (!free(lattice.center_of(c.ix) + t * kNeighbourX[k] * lattice.pitch_m,
                lattice.center_of(c.iy) + t * kNeighbourY[k] * lattice.pitch_m, k * std::numbers::pi / 4))
        return false;
    return true;
  };
  using State = std::tuple<std::int32_t, std::int32_t, unsigned>;
  std::set<State> seen;
  std::queue<State> queue;
  const auto enter = [&](CellIndex c, unsigned k) {
    const CellIndex to{c.ix + kNeighbourX[k], c.iy + kNeighbourY[k]};
    if (may_step(c, k) && seen.insert({to.ix, to.iy, k}).second) queue.push({to.ix, to.iy, k});
  };
  const CellIndex start = lattice.cell_of(p.x_m, p.y_m);
  for (unsigned k = 0; k < 8; ++k)
    if (may_turn(start, p.heading_rad, k * std::numbers::pi / 4)) enter(start, k);
  while (!queue.empty()) {
    const auto [ix, iy, from] = queue.front();
    queue.pop();
    if (std::hypot(lattice.center_of(ix) - p.goal.x_m, lattice.center_of(iy) - p.goal.y_m) <=
        0.75 * lattice.pitch_m)
      return true;
    for (const unsigned turn : {0U, 1U, 2U, 3U, 5U, 6U, 7U}) {  // not half round: either way would do
      const unsigned k = (from + turn) % 8;
      if (may_turn({ix, iy}, from * std::numbers::pi / 4, k * std::numbers::pi / 4)) enter({ix, iy}, k);
    }
  }
  return false;
}

TEST(OutlineSearch, StopsSoonWhenToldTo) {
  const GridMap map = rooms_with_door(0);
  PlanningGrid grid({}, long_robot());
  grid.update(map, {0, 0, 200, 80}, {});
  OutlineSearch search;
  int asked = 0;
  const auto third_time = [&] { return ++asked == 3; };
  const GridCell start = grid.cell_of(2, 2), goal = grid.cell_of(8, 2);
  EXPECT_EQ(search.search(grid, start, 0, goal, third_time), SearchOutcome::kInterrupted);
  EXPECT_EQ(asked, 3);
  EXPECT_LE(search.expanded(), 1000) << "less than a millisecond's work";
  EXPECT_EQ(search.search(grid, start, 0, goal), SearchOutcome::kNoPath) << "and starts afresh";
  EXPECT_GT(search.expanded(), 1000);
}

TEST(OutlineSearch, FindsAWayWhereSteppingAndTurningByBruteForceDoes) {
  constexpr std::int32_t kHalf = 18;
  int found = 0, tight = 0;
  for (unsigned seed = 1; seed < 60; ++seed) {
    if (seed % 3 == 0) continue;  // those have unknown floor
    Problem p = random_problem(seed, kHalf);
    for (std::int32_t iy = -kHalf; iy < kHalf;
         ++iy)  // no closed edges: those bind the wheels, not the outline
      for (std::int32_t ix = -kHalf; ix < kHalf; ++ix)
        if (p.map.state({ix, iy}) == VertexState::kFree) set_cell(p.map, {ix, iy}, VertexState::kFree);
    for (std::int32_t i = -kHalf - 1; i <= kHalf; ++i)
      for (const CellIndex wall : {CellIndex{i, -kHalf - 1}, {i, kHalf}, {-kHalf - 1, i}, {kHalf, i}})
        set_cell(p.map, wall, VertexState::kBlocked);
    if (!reachable(p, 0.5 * p.map.lattice().pitch_m)) continue;
    const Plan plan = Planner({}, p.robot).plan(p.map, pose_at(p.x_m, p.y_m, p.heading_rad), p.goal);
    if (plan.status == PlanStatus::kReached) continue;
    ++found;
    ASSERT_EQ(plan.status, PlanStatus::kFollowing) << "seed " << seed << ": " << plan.reason;
    RobotSettings circle = p.robot;
    circle.footprint.clear();
    tight += Planner({}, circle).plan(p.map, pose_at(p.x_m, p.y_m, p.heading_rad), p.goal).status !=
             PlanStatus::kFollowing;
  }
  EXPECT_GT(found, 5);
  EXPECT_GT(tight, 0) << "problems that a circle does not solve";
}

}  // namespace
}  // namespace floornav
