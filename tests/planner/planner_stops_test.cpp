#include <gtest/gtest.h>

#include "planner/node/planner_node.hpp"
#include "planner_node_bench.hpp"

namespace floornav {
namespace {

TEST(PlannerNode, StopsWhenTheMapperFallsSilentAndGoesOnWhenItSpeaks) {
  Bench bench;
  set_out(bench);
  for (int i = 0; i < 5; ++i) {
    bench.pass(80ms);
    bench.send_pose(2, 3);
  }
  EXPECT_EQ(bench.last().status, path_t::STALE_MAP);
  EXPECT_EQ(bench.last().n_points, 0);
  EXPECT_EQ(bench.last().goal_id, 7);
  EXPECT_FALSE(bench.health().reason.empty());
  bench.send_map(draw_map(room(), kCell_m), false);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING);
}

TEST(PlannerNode, StopsWhenTheMapsEvidenceGrowsOldThoughTheMapperSpeaks) {
  Bench bench;
  set_out(bench);
  bench.stop_evidence();
  bench.send_map(draw_map(room(), kCell_m), false);
  for (int i = 0; i < 8; ++i) {
    bench.pass(80ms);
    bench.send_pose(2, 3);
    bench.send_map(draw_map(room(), kCell_m), false);
  }
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::STALE_MAP);
}

TEST(PlannerNode, StopsAQuarterSecondAfterTheLastEvidenceWhereThatCameTenTimesASecond) {
  Bench bench;
  set_out(bench);
  for (int i = 0; i < 30; ++i) {
    bench.pass(50ms);
    bench.send_pose(2, 3);
    if (i % 2 == 1) bench.send_map(draw_map(room(), kCell_m), false);
  }
  ASSERT_EQ(bench.last().status, path_t::FOLLOWING);
  bench.stop_evidence();
  bench.send_map(draw_map(room(), kCell_m), false);  // repeats what was there: one more change of its time
  bench.paths.clear();
  Micros until_stop{0};
  for (; until_stop < 500ms && (bench.paths.empty() || bench.last().status == path_t::FOLLOWING);
       until_stop += 10ms) {
    bench.pass(10ms);
    bench.send_pose(2, 3);
    bench.send_map(draw_map(room(), kCell_m), false);
  }
  EXPECT_EQ(bench.last().status, path_t::STALE_MAP);
  EXPECT_GE(until_stop, 200ms);
  EXPECT_LE(until_stop, 290ms);
}

TEST(PlannerNode, StopsWhenThePoseGrowsOld) {
  Bench bench;
  set_out(bench);
  for (int i = 0; i < 5; ++i) {
    bench.pass(80ms);
    bench.send_map(draw_map(room(), kCell_m), false);
  }
  EXPECT_EQ(bench.last().status, path_t::STALE_POSE);
  EXPECT_EQ(bench.last().n_points, 0);
}

TEST(PlannerNode, WaitsForAMapAndForFloorNearTheRobot) {
  Bench bench;
  bench.send_pose(2, 3);
  bench.send_goal(7, 8, 3);
  EXPECT_EQ(bench.last().status, path_t::STALE_MAP);
  bench.send_map(GridMap(kCell_m));
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::STALE_MAP) << "an empty map shows no floor";
  bench.send_map(draw_map(room(), kCell_m));
  bench.send_pose(2, 3);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING);
}

TEST(PlannerNode, StopsAfterAPoseJumpUntilTheSurroundingsAreSeenAgain) {
  Bench bench;
  set_out(bench);
  GridMap after(kCell_m);
  after.epoch = 1;
  after.version = 2;
  bench.send_map(after);
  bench.send_pose(2, 3);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::STALE_MAP);
  EXPECT_EQ(bench.last().map_epoch, 1);
  GridMap seen = room_with_block(3, 50, 52);
  seen.epoch = 1;
  bench.send_map(seen);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING);
}

TEST(PlannerNode, TrustsNothingOfAMapperThatWasReplaced) {
  Bench bench;
  set_out(bench);
  bench.pass(600ms);
  bench.restart_mapper();
  bench.send_map(GridMap(kCell_m));
  bench.send_pose(2, 3);
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::STALE_MAP);
  // The same versions as before, other floor.
  bench.send_map(room_with_block(1, 50, 52));
  bench.pass(80ms);
  EXPECT_EQ(bench.last().status, path_t::FOLLOWING);
  EXPECT_GT(bench.last().length, 6.2F);
}

}  // namespace
}  // namespace floornav
