#include "planner/node/goal_desk.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/geometry/pose.hpp"

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
