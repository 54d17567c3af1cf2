#include "planner/node/planner_node.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "planner_node_bench.hpp"

namespace floornav {
namespace {

TEST(PlannerNode, AnswersAGoalAtOnceAndEchoesItsId) {
  Bench bench;
  bench.send_map(draw_map(room(), kCell_m));
  bench.send_pose(2, 3);
  EXPECT_TRUE(bench.paths.empty());
  bench.send_goal(7, 8, 3);
  ASSERT_EQ(bench.paths.size(), 1U);
  const path_t& path = bench.last();
  EXPECT_EQ(path.status, path_t::FOLLOWING) << path.reason;
  EXPECT_EQ(path.goal_id, 7);
  EXPECT_EQ(path.map_version, 1);
  EXPECT_EQ(path.utime, bench.utime());
  EXPECT_EQ(path.valid_for_ms, 250);
  EXPECT_NEAR(path.length, 6.0F, 1e-5F);
  ASSERT_GT(path.n_points, 2);
  EXPECT_FLOAT_EQ(path.points.front().x, 2.0F);
  EXPECT_FLOAT_EQ(path.points.back().x, 8.0F);
  EXPECT_EQ(path.points.back().speed, 0.0F);
}

TEST(PlannerNode, PublishesAtTenHertzOrMoreWithAndWithoutAGoal) {
  Bench bench;
  bench.pass(1s);
  EXPECT_GE(bench.paths.size(), 10U);
  EXPECT_EQ(bench.last().status, path_t::IDLE);
  set_out(bench);
  bench.paths.clear();
  for (int i = 0; i < 20; ++i) {
    bench.send_pose(2, 3);
    bench.send_map(draw_map(room(), kCell_m), false);
    bench.pass(50ms);
  }
  EXPECT_GE(bench.paths.size(), 10U);
  for (const path_t& path : bench.paths) EXPECT_EQ(path.status, path_t::FOLLOWING) << path.reason;
}

TEST(PlannerNode, ReplansAtOnceWhenTheWayAheadIsShut) {
  Bench bench;
  set_out(bench);
  bench.paths.clear();
  bench.send_map(room_with_block(2, 50, 52));
  ASSERT_EQ(bench.paths.size(), 1U) << "without waiting for a tick";
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING);
  EXPECT_EQ(bench.last().map_version, 2);
  EXPECT_GT(bench.last().length, 6.2F);
}

TEST(PlannerNode, KeepsQuietAboutChangesBesideTheWay) {
  Bench bench;
  set_out(bench);
  bench.paths.clear();
  auto rows = room();
  rows[50][50] = '#';
  GridMap map = draw_map(rows, kCell_m);
  map.version = 2;
  for (const auto& [index, tile] : map.tiles()) tile->version = 2;
  bench.send_map(map);
  EXPECT_TRUE(bench.paths.empty());
}

TEST(PlannerNode, ReplansAtOnceWhenTheRobotLeavesTheWay) {
  Bench bench;
  set_out(bench);
  bench.paths.clear();
  bench.pass(10ms);
  bench.send_pose(2.5, 3.1);
  EXPECT_TRUE(bench.paths.empty());
  bench.pass(10ms);
  bench.send_pose(2.5, 4.5);
  ASSERT_EQ(bench.paths.size(), 1U);
  EXPECT_FLOAT_EQ(bench.last().points.front().y, 4.5F);
}

TEST(PlannerNode, CancelsAtOnceAndDoesNotDriveTheGoalAgain) {
  Bench bench;
  set_out(bench);
  bench.send_goal(7, 8, 3, goal_t::CANCEL);
  EXPECT_EQ(bench.last().status, path_t::CANCELLED);
  EXPECT_EQ(bench.last().n_points, 0);
  bench.send_goal(7, 8, 3);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::CANCELLED);
  bench.send_goal(8, 5, 3);
  EXPECT_EQ(bench.last().goal_id, 8);
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING);
}

TEST(PlannerNode, SaysReachedAndStaysThere) {
  Bench bench;
  set_out(bench);
  bench.pass(10ms);
  bench.send_pose(7.95, 3.02);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::REACHED);
  bench.send_pose(7.5, 3.0);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::REACHED);
  EXPECT_EQ(bench.last().n_points, 0);
}

TEST(PlannerNode, PublishesAStopWhenItEnds) {
  Bench bench;
  set_out(bench);
  bench.stop_node();
  EXPECT_EQ(bench.last().status, path_t::IDLE);
  EXPECT_EQ(bench.last().n_points, 0);
}

TEST(PlannerNode, CountsAbsurdInputAndGoesOn) {
  Bench bench;
  set_out(bench);
  bench.send_pose(std::numeric_limits<double>::quiet_NaN(), 3);
  bench.send_pose(1e30, 3);
  bench.send_goal(9, std::numeric_limits<double>::infinity(), 3);
  EXPECT_EQ(bench.counts(channel::kPose).malformed, 2);
  EXPECT_EQ(bench.counts(channel::kGoal).malformed, 1);
  bench.send_map(draw_map(room(), kCell_m), false);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING);
  EXPECT_EQ(bench.last().goal_id, 7);
}

/// Two rooms; through the door between them, 0.2 m beside the robot, runs a trench whose ground no camera
/// sees. The other door is 4 m away.
GridMap rooms_with_trench(std::int64_t version) {
  auto rows = room();
  for (std::size_t y = 0; y < 60; ++y) {
    const bool trench = y > 3 && y<15, door = y> 45 && y < 57;
    for (std::size_t x = 50; x < 52; ++x) rows[y][x] = trench ? ' ' : door ? '.' : '#';
  }
  GridMap map = draw_map(rows, kCell_m);
  map.version = version;
  return map;
}

TEST(PlannerNode, GoesAnotherWayOnceTheFloorAheadWasLookedAtInVain) {
  Bench bench;
  bench.send_map(rooms_with_trench(1));
  bench.send_pose(2.0, 1.0);  // here floor is assumed
  bench.send_goal(7, 5.8, 1.0);
  const auto stand_for = [&](Micros time) {
    for (const Micros end = bench.now() + time; bench.now() < end;) {
      bench.pass(80ms);
      bench.send_map(rooms_with_trench(1), false);
      bench.send_pose(4.65, 1.0);
    }
  };
  stand_for(10s);
  EXPECT_EQ(bench.last().status, path_t::FRONTIER) << bench.last().reason;
  EXPECT_LT(bench.last().length, 0.15F);
  stand_for(4s);
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING) << bench.last().reason;
  EXPECT_GT(bench.last().length, 8.0F);
  bench.send_goal(8, 5.8, 1.0);
  EXPECT_EQ(bench.last().status, path_t::FRONTIER) << "a new goal gives the floor another chance";
}

TEST(PlannerNode, SaysWhyThereIsNoWayInPathAndHealth) {
  Bench bench;
  bench.send_map(room_with_block(1, 75, 85));
  bench.send_pose(2, 3);
  bench.send_goal(7, 8, 3);
  EXPECT_EQ(bench.last().status, path_t::GOAL_BLOCKED);
  EXPECT_FALSE(bench.last().reason.empty());
  EXPECT_EQ(bench.health().state, health_t::DEGRADED);
  EXPECT_EQ(bench.health().reason, bench.last().reason);
}

}  // namespace
}  // namespace floornav
