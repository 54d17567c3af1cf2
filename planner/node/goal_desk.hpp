#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "floornav/goal_t.hpp"
#include "planner/plan.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// Keeps the goal in force. A goal is repeated by its sender until it is acknowledged, so that an id counts
/// once: one that was cancelled or reached does not start again.
class GoalDesk {
 public:
  enum class State : std::uint8_t { kIdle, kActive, kReached, kCancelled };

  /// True where the goal in force has changed. Throws std::invalid_argument for a goal that is none.
  bool accept(const goal_t& message);
  /// LOCAL_TO_GLOBAL: the goal stays where it was in the global frame, from the first one on that is told
  /// while it is in force. True where it has moved in the local frame. Throws std::invalid_argument, and
  /// nothing changes, for a transform that moves it to an absurd place.
  bool take(const Pose& T_global_local);
  void reached() { state_ = State::kReached; }

  [[nodiscard]] State state() const { return state_; }
  /// Of the goal in force; 0: none yet.
  [[nodiscard]] std::int64_t id() const { return id_; }
  [[nodiscard]] const Goal& goal() const { return goal_; }

 private:
  [[nodiscard]] bool is_over(std::int64_t id) const;
  void replace(std::int64_t id, State state);
  void remember(std::int64_t id);

  State state_ = State::kIdle;
  std::int64_t id_ = 0;
  void anchor();

  Goal goal_;
  std::optional<Pose> T_global_local_;
  std::optional<Eigen::Vector3d> goal_global_m_;
  std::deque<std::int64_t> over_;  ///< ids that shall not start (again), newest last
};

}  // namespace floornav
