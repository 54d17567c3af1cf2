#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lcmtypes/channels.hpp"
#include "map_drawing.hpp"
#include "planner/node/planner_node.hpp"

namespace floornav {

using namespace std::chrono_literals;

inline constexpr double kCell_m = 0.1;

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
  [[nodiscard]] Micros now() const { return now_; }
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

inline std::vector<std::string> room() {
  std::vector<std::string> rows(60, "#" + std::string(98, '.') + "#");
  rows.front() = rows.back() = std::string(100, '#');
  return rows;
}

/// A later version of the room's map in which some cells are blocked.
inline GridMap room_with_block(std::int64_t version, std::size_t x0, std::size_t x1) {
  auto rows = room();
  for (std::size_t y = 20; y < 40; ++y)
    for (std::size_t x = x0; x < x1; ++x) rows[y][x] = '#';
  GridMap map = draw_map(rows, kCell_m);
  map.version = version;
  for (const auto& [index, tile] : map.tiles()) tile->version = version;
  return map;
}

/// A bench on its way from (2, 3) to (8, 3).
inline void set_out(Bench& bench) {
  bench.send_map(draw_map(room(), kCell_m));
  bench.send_pose(2, 3);
  bench.send_goal(7, 8, 3);
}

}  // namespace floornav
