#include <algorithm>
#include <cmath>
#include <queue>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "map_drawing.hpp"
#include "planner/planner.hpp"

namespace floornav {
namespace {

Pose pose_at(double x_m, double y_m) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
  return pose;
}

struct Problem {
  GridMap map;
  RobotSettings robot;
  PlannerSettings settings;
  double start_x_m, start_y_m;
  Goal goal;
};

Problem random_problem(unsigned seed, bool with_unknown) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const double resolution_m = seed % 2 == 0 ? 0.05 : 0.1;
  Problem p{random_map(random, 40, resolution_m, with_unknown), {}, {}, 0, 0, {}};
  p.robot.radius_m = resolution_m * uniform(1.0, 4.0);
  p.settings.assumed_radius_m = resolution_m * uniform(0.0, 6.0);
  const double half_m = 36 * resolution_m;
  p.start_x_m = uniform(-half_m, half_m);
  p.start_y_m = uniform(-half_m, half_m);
  p.goal = {uniform(-half_m, half_m), uniform(-half_m, half_m), resolution_m * uniform(0.0, 5.0)};
  return p;
}

/// Distance from a point to the square of a cell.
double distance_to_cell(double x_m, double y_m, CellIndex cell, double side_m) {
  const double dx = std::max({cell.ix * side_m - x_m, x_m - (cell.ix + 1) * side_m, 0.0});
  const double dy = std::max({cell.iy * side_m - y_m, y_m - (cell.iy + 1) * side_m, 0.0});
  return std::hypot(dx, dy);
}

/// The first cell, if any, under the robot's circle that is neither free nor assumed.
std::string fault_under_circle(const Problem& p, double x_m, double y_m, double margin_m = 0) {
  const Lattice& lattice = p.map.lattice();
  const double r = p.robot.radius_m + margin_m;
  const double assumed_m = p.robot.radius_m + p.settings.assumed_radius_m;
  const CellIndex low = lattice.cell_of(x_m - r, y_m - r), high = lattice.cell_of(x_m + r, y_m + r);
  for (std::int32_t iy = low.iy; iy <= high.iy; ++iy)
    for (std::int32_t ix = low.ix; ix <= high.ix; ++ix) {
      if (distance_to_cell(x_m, y_m, {ix, iy}, lattice.pitch_m) >= r - 1e-9) continue;
      const VertexState state = p.map.state({ix, iy});
      if (state == VertexState::kBlocked) return "blocked";
      const double from_start_m =
          std::hypot(lattice.center_of(ix) - p.start_x_m, lattice.center_of(iy) - p.start_y_m);
      const bool under_robot = from_start_m <= p.robot.radius_m + lattice.pitch_m + 1e-9;
      if (state == VertexState::kUnknown && from_start_m > assumed_m + 1e-9 && !under_robot) return "unknown";
    }
  return "";
}

/// Distance to the nearest blocked cell, as far as `most_m`.
double distance_to_blocked(const Problem& p, double x_m, double y_m, double most_m) {
  const Lattice& lattice = p.map.lattice();
  const CellIndex low = lattice.cell_of(x_m - most_m, y_m - most_m),
                  high = lattice.cell_of(x_m + most_m, y_m + most_m);
  double nearest_m = most_m;
  for (std::int32_t iy = low.iy; iy <= high.iy; ++iy)
    for (std::int32_t ix = low.ix; ix <= high.ix; ++ix)
      if (p.map.state({ix, iy}) == VertexState::kBlocked)
        nearest_m = std::min(nearest_m, distance_to_cell(x_m, y_m, {ix, iy}, lattice.pitch_m));
  return nearest_m;
}

bool edge_open(const GridMap& map, CellIndex from, CellIndex to) {
  const auto bit_of = [&](CellIndex a, CellIndex b) {
    for (unsigned k = 0; k < 8; ++k) {
      if (a.ix + kNeighbourX[k] != b.ix || a.iy + kNeighbourY[k] != b.iy) continue;
      const GridTile* const tile = map.find(GridMap::tile_of(a));
      return (tile->edges[static_cast<std::size_t>(GridTile::index_of(a))] >> k & 1) != 0;
    }
    ADD_FAILURE() << "the path jumps over a cell";
    return false;
  };
  const bool both_seen = map.state(from) == VertexState::kFree && map.state(to) == VertexState::kFree;
  return !both_seen || (bit_of(from, to) && bit_of(to, from));
}

/// Distance to the nearest line between two free cells that a closed edge parts, as far as `most_m`.
double distance_to_step(const Problem& p, double x_m, double y_m, double most_m) {
  const Lattice& lattice = p.map.lattice();
  const double side_m = lattice.pitch_m;
  const CellIndex low = lattice.cell_of(x_m - most_m - side_m, y_m - most_m - side_m),
                  high = lattice.cell_of(x_m + most_m, y_m + most_m);
  double nearest_m = most_m;
  for (std::int32_t iy = low.iy; iy <= high.iy; ++iy)
    for (std::int32_t ix = low.ix; ix <= high.ix; ++ix)
      for (const CellIndex to : {CellIndex{ix + 1, iy}, CellIndex{ix, iy + 1}}) {
        if (edge_open(p.map, {ix, iy}, to)) continue;
        // The line between them runs from the upper corner of the lower one, up or to the right.
        const double x0 = to.ix * side_m, y0 = to.iy * side_m;
        const double x1 = to.ix > ix ? x0 : x0 + side_m, y1 = to.iy > iy ? y0 : y0 + side_m;
        nearest_m = std::min(
            nearest_m, std::hypot(std::max({x0 - x_m, x_m - x1, 0.0}), std::max({y0 - y_m, y_m - y1, 0.0})));
      }
  return nearest_m;
}

double wheels_m(const Problem& p) {
  return std::min(0.5 * p.robot.track_m, p.robot.radius_m);
}

/// Looks at the path every fifth of a cell. A robot that does not fit where it stands first comes away from
/// what is too near.
void expect_safe(const Problem& p, const Plan& plan, unsigned seed) {
  const Lattice& lattice = p.map.lattice();
  std::optional<CellIndex> last;
  const double nearest_m =
      distance_to_blocked(p, p.start_x_m, p.start_y_m, p.robot.radius_m) - lattice.pitch_m;
  for (std::size_t i = 1; i < plan.points.size(); ++i) {
    const PathPoint &a = plan.points[i - 1], &b = plan.points[i];
    const double length_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    const int samples = std::max(1, static_cast<int>(std::ceil(length_m / (0.2 * lattice.pitch_m))));
    for (int k = 0; k <= samples; ++k) {
      const double t = static_cast<double>(k) / samples;
      const double x = a.x_m + t * (b.x_m - a.x_m), y = a.y_m + t * (b.y_m - a.y_m);
      const double to_step_m = distance_to_step(p, x, y, wheels_m(p));
      if (i > plan.way_out_points) {
        ASSERT_EQ(fault_under_circle(p, x, y), "") << "seed " << seed << " at " << x << ", " << y;
        ASSERT_GE(to_step_m, wheels_m(p) - 1e-9) << "seed " << seed << " at " << x << ", " << y;
      } else {
        ASSERT_GE(distance_to_blocked(p, x, y, p.robot.radius_m), nearest_m) << "seed " << seed;
      }
      const CellIndex cell = lattice.cell_of(x, y);
      if (last && *last != cell) {
        ASSERT_TRUE(edge_open(p.map, *last, cell)) << "seed " << seed;
      }
      last = cell;
    }
  }
}

class PathOfSeed : public testing::TestWithParam<unsigned> {};

TEST_P(PathOfSeed, TouchesNothingBlockedOrUnknownAndCrossesNoClosedEdge) {
  int published = 0, frontiers = 0;
  for (unsigned seed = GetParam() * 30; seed < GetParam() * 30 + 30; ++seed) {
    const Problem p = random_problem(seed, true);
    Planner planner(p.settings, p.robot);
    const Plan plan = planner.plan(p.map, pose_at(p.start_x_m, p.start_y_m), p.goal);
    if (plan.points.empty()) continue;
    ++published;
    frontiers += plan.status == PlanStatus::kFrontier;
    EXPECT_EQ(plan.points.back().speed_mps, 0.0);
    expect_safe(p, plan, seed);
    if (plan.status == PlanStatus::kFollowing) {
      const PathPoint& end = plan.points.back();
      EXPECT_LE(std::hypot(end.x_m - p.goal.x_m, end.y_m - p.goal.y_m),
                std::max(p.goal.tolerance_m, 0.75 * p.map.lattice().pitch_m) + 1e-9);
    } else {
      EXPECT_EQ(plan.status, PlanStatus::kFrontier);
    }
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(published, 5);
  EXPECT_GT(frontiers, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, PathOfSeed, testing::Range(0U, 8U));

/// Whether steps between cells whose circle, `margin` cells wider than the robot, touches nothing blocked
/// lead from the start's cell to within the goal's tolerance.
bool reachable(const Problem& p, double margin) {
  const Lattice& lattice = p.map.lattice();
  const auto fits = [&](CellIndex c) {
    const double x_m = lattice.center_of(c.ix), y_m = lattice.center_of(c.iy);
    const double margin_m = margin * lattice.pitch_m;
    // A step binds as wide as the cells beside it are.
    const double off_step_m = wheels_m(p) + lattice.pitch_m * 1.5 + margin_m;
    return fault_under_circle(p, x_m, y_m, margin_m).empty() &&
           distance_to_step(p, x_m, y_m, off_step_m) >= off_step_m;
  };
  const CellIndex start = lattice.cell_of(p.start_x_m, p.start_y_m);
  if (!fits(start)) return false;
  std::set<CellIndex> seen{start};
  std::queue<CellIndex> queue;
  queue.push(start);
  while (!queue.empty()) {
    const CellIndex c = queue.front();
    queue.pop();
    if (std::hypot(lattice.center_of(c.ix) - p.goal.x_m, lattice.center_of(c.iy) - p.goal.y_m) <=
        std::max(p.goal.tolerance_m, 0.75 * lattice.pitch_m))
      return true;
    for (unsigned k = 0; k < 8; k += 2) {
      const CellIndex to{c.ix + kNeighbourX[k], c.iy + kNeighbourY[k]};
      if (edge_open(p.map, c, to) && fits(to) && seen.insert(to).second) queue.push(to);
    }
  }
  return false;
}

/// Nothing unknown, and walls all around; the start in mid cell, so that both searches begin alike.
Problem known_problem(unsigned seed) {
  Problem p = random_problem(seed, false);
  for (std::int32_t i = -41; i <= 40; ++i)
    for (const CellIndex wall : {CellIndex{i, -41}, {i, 40}, {-41, i}, {40, i}})
      set_cell(p.map, wall, VertexState::kBlocked);
  const Lattice& lattice = p.map.lattice();
  p.start_x_m = lattice.center_of(lattice.index_of(p.start_x_m));
  p.start_y_m = lattice.center_of(lattice.index_of(p.start_y_m));
  return p;
}

TEST(PathOnKnownFloor, IsFoundWhereStraightStepsLeadThereAndNotWhereNoneDo) {
  int found = 0, absent = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Problem p = known_problem(seed);
    Planner planner(p.settings, p.robot);
    const Plan plan = planner.plan(p.map, pose_at(p.start_x_m, p.start_y_m), p.goal);
    if (plan.status == PlanStatus::kReached) continue;
    if (reachable(p, 0.3)) {
      ++found;
      ASSERT_EQ(plan.status, PlanStatus::kFollowing) << "seed " << seed << ": " << plan.reason;
    } else if (plan.status == PlanStatus::kNoPath || plan.status == PlanStatus::kGoalBlocked ||
               plan.status == PlanStatus::kStartBlocked) {
      ++absent;
      ASSERT_TRUE(plan.points.empty());
    }
  }
  EXPECT_GT(found, 15);
  EXPECT_GT(absent, 2);
}

TEST(PathOnKnownFloor, StaysSafeWhereAMovingRobotIsSentElsewhere) {
  int sent = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Problem p = known_problem(seed);
    Planner planner(p.settings, p.robot);
    const Plan before = planner.plan(p.map, pose_at(p.start_x_m, p.start_y_m), p.goal);
    if (before.points.size() < 10 || before.way_out_points > 0) continue;
    const PathPoint& here = before.points[before.points.size() / 2];
    Pose pose = pose_at(here.x_m, here.y_m);
    pose.rotate(Eigen::AngleAxisd(here.heading_rad, Eigen::Vector3d::UnitZ()));
    const Goal back{p.start_x_m, p.start_y_m, 0.2};
    const Plan plan = planner.plan(p.map, pose, back, &before, {}, here.speed_mps);
    p.start_x_m = here.x_m, p.start_y_m = here.y_m;
    expect_safe(p, plan, seed);
    if (testing::Test::HasFatalFailure()) return;
    sent += plan.status == PlanStatus::kFollowing;
  }
  EXPECT_GT(sent, 20);
}

TEST(PathOnKnownFloor, IsTheSameBytesEachTime) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Problem p = random_problem(seed, true);
    Planner once(p.settings, p.robot), again(p.settings, p.robot);
    const Plan a = once.plan(p.map, pose_at(p.start_x_m, p.start_y_m), p.goal);
    again.plan(p.map, pose_at(p.start_x_m, p.start_y_m), {p.start_x_m + 1, p.start_y_m, 0.5});
    const Plan b = again.plan(p.map, pose_at(p.start_x_m, p.start_y_m), p.goal);
    ASSERT_EQ(a.status, b.status);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      ASSERT_EQ(a.points[i].x_m, b.points[i].x_m);
      ASSERT_EQ(a.points[i].y_m, b.points[i].y_m);
      ASSERT_EQ(a.points[i].speed_mps, b.points[i].speed_mps);
    }
  }
}

}  // namespace
}  // namespace floornav
