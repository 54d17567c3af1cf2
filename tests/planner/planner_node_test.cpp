#include "planner/node/planner_node.hpp"

#include <chrono>
#include <limits>

#include <gtest/gtest.h>

#include "lcmtypes/channels.hpp"
#include "map_drawing.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr double kCell_m = 0.1;

/// A node with a bus of its own, and time that passes only when told to.
class Bench {
 public:
  Bench() : node_(PlannerSettings{}, small_robot()) { node_.subscribe(inbox_); }

  template <class Message>
  void deliver(const std::string& channel, Message message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    inbox_.deliver(channel, bytes, now_);
    step();
  }
  void send_pose(double x_m, double y_m) {
    pose_t pose{};
    pose.utime = utime();
    pose.pos[0] = x_m;
    pose.pos[1] = y_m;
    pose.orientation[0] = 1;
    deliver(channel::kPose, pose);
  }
  void send_goal(std::int64_t id, double x_m, double y_m, std::int8_t command = goal_t::GO) {
    goal_t goal{};
    head(goal);
    goal.id = id;
    goal.command = command;
    goal.pos[0] = x_m;
    goal.pos[1] = y_m;
    goal.tolerance = 0.1F;
    deliver(channel::kGoal, goal);
  }
  void send_map(const GridMap& map, bool with_tiles = true) {
    const auto tiles = with_tiles ? map.sorted_tiles() : std::vector<CellIndex>{};
    for (grid_map_t& message : to_messages(map, tiles, {utime(), 0.02F, Pose::Identity()})) {
      head(message);
      message.utime = evidence_stopped_ ? 1 : utime();
      deliver(channel::kGridMap, message);
    }
  }
  /// Passes time with ticks as an executor fires them.
  void pass(Micros time) {
    const Micros end = now_ + time;
    for (; next_tick_ <= end; next_tick_ += node_.tick_period()) {
      now_ = next_tick_;
      node_.tick(now_, out_);
      step();
    }
    now_ = end;
  }
  void step() {
    while (node_.step(now_, budget_, out_)) {
    }
    for (const EncodedMessage& encoded : out_.take()) {
      EXPECT_EQ(encoded.channel, channel::kPath);
      path_t path;
      ASSERT_EQ(path.decode(encoded.bytes.data(), 0, static_cast<int>(encoded.bytes.size())),
                static_cast<int>(encoded.bytes.size()));
      paths.push_back(path);
    }
  }
  void stop_node() {
    node_.stop(now_, out_);
    step();
  }
  void restart_mapper() { ++mapper_session_; }
  void stop_evidence() { evidence_stopped_ = true; }
  [[nodiscard]] const path_t& last() const { return paths.back(); }
  [[nodiscard]] health_t health() const {
    health_t health{};
    health.state = health_t::OK;
    node_.report(health);
    return health;
  }
  [[nodiscard]] ChannelCounts counts(const std::string& channel) const { return inbox_.counts().at(channel); }
  [[nodiscard]] std::int64_t utime() const { return 1'700'000'000'000'000 + now_.count(); }

  std::vector<path_t> paths;

 private:
  static RobotSettings small_robot() {
    RobotSettings robot;
    robot.radius_m = 0.3;
    return robot;
  }
  void head(goal_t& m) { m.utime = utime(), m.source = "test", m.session = 1, m.seq = ++goal_seq_; }
  void head(grid_map_t& m) { m.source = "mapper", m.session = mapper_session_, m.seq = ++map_seq_; }

  Inbox inbox_;
  Outbox out_{Identity{"planner", 99}};
  UnlimitedBudget budget_;
  PlannerNode node_;
  Micros now_{0};
  Micros next_tick_{20ms};
  std::int64_t goal_seq_ = 0, map_seq_ = 0, mapper_session_ = 5;
  bool evidence_stopped_ = false;
};

std::vector<std::string> room() {
  std::vector<std::string> rows(60, "#" + std::string(98, '.') + "#");
  rows.front() = rows.back() = std::string(100, '#');
  return rows;
}

/// A later version of the room's map in which some cells are blocked.
GridMap room_with_block(std::int64_t version, std::size_t x0, std::size_t x1) {
  auto rows = room();
  for (std::size_t y = 20; y < 40; ++y)
    for (std::size_t x = x0; x < x1; ++x) rows[y][x] = '#';
  GridMap map = draw_map(rows, kCell_m);
  map.version = version;
  for (const auto& [index, tile] : map.tiles()) tile->version = version;
  return map;
}

/// A bench on its way from (2, 3) to (8, 3).
void set_out(Bench& bench) {
  bench.send_map(draw_map(room(), kCell_m));
  bench.send_pose(2, 3);
  bench.send_goal(7, 8, 3);
}

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
