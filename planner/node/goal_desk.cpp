#include "planner/node/goal_desk.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace floornav {
namespace {

constexpr double kMaxTolerance_m = 100.0;
constexpr std::size_t kRemembered = 64;

void check(const goal_t& m) {
  if (m.command != goal_t::GO && m.command != goal_t::CANCEL)
    throw std::invalid_argument("goal: unknown command");
  if (m.id == 0) throw std::invalid_argument("goal: id 0 means no goal");
  if (m.command == goal_t::CANCEL) return;
  // Written so that a NaN is refused too.
  if (!(std::abs(m.pos[0]) <= kMaxPosition_m && std::abs(m.pos[1]) <= kMaxPosition_m))
    throw std::invalid_argument("goal: absurd position");
  if (!(m.tolerance >= 0 && m.tolerance <= kMaxTolerance_m))
    throw std::invalid_argument("goal: absurd tolerance");
}

}  // namespace

bool GoalDesk::accept(const goal_t& message) {
  check(message);
  if (is_over(message.id)) return false;
  if (message.command == goal_t::CANCEL) {
    // The cancel of a goal that never came leaves another one alone, but the goal shall not start when it
    // comes late.
    if (message.id != id_ && state_ == State::kActive) {
      remember(message.id);
      return false;
    }
    if (message.id == id_ && state_ != State::kActive) return false;
    replace(message.id, State::kCancelled);
    return true;
  }
  if (message.id == id_) return false;
  replace(message.id, State::kActive);
  goal_ = {message.pos[0], message.pos[1], static_cast<double>(message.tolerance)};
  goal_global_m_.reset();
  anchor();
  return true;
}

void GoalDesk::anchor() {
  if (T_global_local_ && !goal_global_m_)
    goal_global_m_ = *T_global_local_ * Eigen::Vector3d(goal_.x_m, goal_.y_m, 0);
}

bool GoalDesk::take(const Pose& T_global_local) {
  constexpr double kNoticed_m = 0.01;
  if (state_ != State::kActive || !goal_global_m_) {
    T_global_local_ = T_global_local;
    if (state_ == State::kActive) anchor();
    return false;
  }
  const Eigen::Vector2d place_m = (T_global_local.inverse() * *goal_global_m_).head<2>();
  if (!(place_m.cwiseAbs().maxCoeff() <= kMaxPosition_m))
    throw std::invalid_argument("LOCAL_TO_GLOBAL: moves the goal to an absurd place");
  T_global_local_ = T_global_local;
  if ((place_m - Eigen::Vector2d(goal_.x_m, goal_.y_m)).norm() <= kNoticed_m) return false;
  goal_.x_m = place_m.x();
  goal_.y_m = place_m.y();
  return true;
}

bool GoalDesk::is_over(std::int64_t id) const {
  return std::find(over_.begin(), over_.end(), id) != over_.end();
}

void GoalDesk::replace(std::int64_t id, State state) {
  if (id_ != 0 && id_ != id) remember(id_);
  id_ = id;
  state_ = state;
}

void GoalDesk::remember(std::int64_t id) {
  over_.push_back(id);
  if (over_.size() > kRemembered) over_.pop_front();
}

}  // namespace floornav
