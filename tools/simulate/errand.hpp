#pragma once

#include <cstdint>
#include <deque>

#include <Eigen/Core>

#include "floornav/goal_t.hpp"
#include "floornav/path_t.hpp"
#include "runtime/process/time.hpp"

namespace floornav {

/// Sends a robot to a goal as an application does: repeats the goal, and where the robot stands and PATH says
/// that it cannot go on, has it look from elsewhere before it asks again. Where the floor ahead cannot be
/// seen that is a metre back on its way, where the goal is shut off as near to it as a way leads.
class Errand {
 public:
  Errand(const Eigen::Vector2d& goal_m, double tolerance_m);

  /// What is to be sent on GOAL now.
  [[nodiscard]] goal_t goal(std::int64_t utime_us) const;

  /// The newest PATH, where the robot believes to be, and whether it moves.
  void follow(const path_t& path, const Eigen::Vector2d& believed_m, bool moves, Micros now);

  /// The robot is where it wants to look from.
  [[nodiscard]] bool looks_around() const { return looks_around_; }
  /// It has turned once around there: on to the goal again.
  void has_looked();

  /// PATH says that the errand's own goal is reached.
  [[nodiscard]] bool done(const path_t& path) const {
    return !aside_ && path.goal_id == id_ && path.status == path_t::REACHED;
  }

 private:
  void try_elsewhere(const path_t& path);
  void go(const Eigen::Vector2d& place_m, double tolerance_m, bool aside);
  void remember(const Eigen::Vector2d& believed_m);

  Eigen::Vector2d goal_m_;
  double tolerance_m_;
  std::int64_t id_ = 1;
  Eigen::Vector2d place_m_;  ///< that the robot is sent to now
  double near_m_;
  bool aside_ = false;  ///< it is not the goal
  bool looks_around_ = false;
  int tries_ = 0;
  double wide_m_;  ///< the tolerance that is tried next
  Micros stuck_since_{0};
  bool stuck_ = false;
  std::deque<Eigen::Vector2d> trail_m_;  ///< where the robot was, oldest first
};

}  // namespace floornav
