#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floornav/path_t.hpp"
#include "floornav/pose_t.hpp"
#include "floornav/rigid_transform_t.hpp"
#include "mapping/node/grid_map_message.hpp"
#include "planner/node/goal_desk.hpp"
#include "planner/node/speed_estimate.hpp"
#include "planner/planner.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/process/node.hpp"

namespace floornav {

/// GRID_MAP, POSE, GOAL and LOCAL_TO_GLOBAL in, PATH out: every 80 ms, and at once when a goal comes or goes,
/// the way ahead is shut or the robot has left it. A stop within 20 ms of the moment when the map or the pose
/// has become stale, and after a start or a jump of the pose until something around the robot was seen.
class PlannerNode final : public Node {
 public:
  PlannerNode(const PlannerSettings& settings, const RobotSettings& robot);

  [[nodiscard]] std::string name() const override { return "planner"; }
  [[nodiscard]] std::vector<std::string> outputs() const override;
  void subscribe(Inbox& inbox) override;
  bool step(Micros now, Budget& budget, Outbox& out) override;
  void tick(Micros now, Outbox& out) override;
  [[nodiscard]] Micros tick_period() const override { return std::chrono::milliseconds(20); }
  [[nodiscard]] std::optional<Micros> deadline() const override { return std::chrono::milliseconds(60); }
  void stop(Micros now, Outbox& out) override;
  void report(health_t& health) const override;

 private:
  void accept_map(const grid_map_t& message, Micros now);
  void accept_pose(const pose_t& message, Micros now);
  [[nodiscard]] bool must_replan();
  [[nodiscard]] path_t next_path(Micros now, Budget& budget);
  [[nodiscard]] path_t plan(Micros now, Budget& budget);
  [[nodiscard]] Plan plan_within(Budget& budget);
  [[nodiscard]] bool looked_in_vain(const Plan& plan, Micros now);
  void give_up_floor_ahead();
  void open_all();
  [[nodiscard]] std::optional<path_t> stale(Micros now);
  void hear_evidence(Micros now);
  [[nodiscard]] std::chrono::duration<double, std::milli> evidence_timeout() const;
  [[nodiscard]] bool surroundings_seen();
  void publish(path_t message, Outbox& out);

  PlannerSettings settings_;
  double radius_m_;
  Planner planner_;
  GridMapReceiver map_;
  GoalDesk goal_;
  std::optional<Plan> plan_;                 ///< that the robot follows
  std::optional<Micros> at_frontier_since_;  ///< where the path ended at once before floor never seen
  std::vector<AssumedFloor> given_up_;       ///< floor that was looked at in vain on the way to this goal

  Pose T_world_body_ = Pose::Identity();
  SpeedEstimate speed_;
  std::int64_t pose_utime_us_ = 0;
  std::optional<Micros> pose_heard_;
  std::optional<Micros> map_heard_;
  Micros evidence_heard_{0};                  ///< when the map's utime last changed
  std::optional<double> evidence_period_ms_;  ///< between such changes, smoothed
  bool surroundings_seen_ = false;            ///< in this epoch of the map
  int ticks_ = 0;                             ///< since the last path that was due
  bool driving_ = false;                      ///< the last path had points
  bool due_ = false;                          ///< a path is due by the tick
  bool goal_changed_ = false;
  bool inputs_changed_ = false;  ///< map or pose, since the last look

  std::string trouble_;  ///< why there is a goal and no way to it; empty: there is one, or no goal
  std::int64_t interrupted_ = 0;
  std::int64_t old_poses_ = 0;
};

}  // namespace floornav
