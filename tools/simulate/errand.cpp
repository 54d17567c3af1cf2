#include "tools/simulate/errand.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr Micros kPatience = 1500ms;  ///< that long the robot stands before it counts as stuck
constexpr int kTries = 6;
constexpr double kTrail_m = 0.1;   ///< between two remembered places
constexpr std::size_t kBack = 10;  ///< of them
constexpr double kNear_m = 0.2;
constexpr double kWidest_m = 8.0;

bool cannot_go_on(const path_t& path) {
  return path.status == path_t::NO_PATH || path.status == path_t::GOAL_BLOCKED ||
         path.status == path_t::FRONTIER;
}

}  // namespace

Errand::Errand(const Eigen::Vector2d& goal_m, double tolerance_m)
    : goal_m_(goal_m), tolerance_m_(tolerance_m), place_m_(goal_m), near_m_(tolerance_m), wide_m_(1.0) {}

goal_t Errand::goal(std::int64_t utime_us) const {
  goal_t message{};
  message.utime = utime_us;
  message.id = id_;
  message.command = goal_t::GO;
  message.pos[0] = place_m_.x();
  message.pos[1] = place_m_.y();
  message.tolerance = static_cast<float>(near_m_);
  return message;
}

void Errand::follow(const path_t& path, const Eigen::Vector2d& believed_m, bool moves, Micros now) {
  remember(believed_m);
  if (path.goal_id != id_ || looks_around_) return;
  if (aside_ && path.status == path_t::REACHED) {
    looks_around_ = true;
    return;
  }
  const bool stuck = !moves && cannot_go_on(path);
  if (stuck && !stuck_) stuck_since_ = now;
  stuck_ = stuck;
  if (stuck_ && now - stuck_since_ >= kPatience && tries_ < kTries) try_elsewhere(path);
}

void Errand::try_elsewhere(const path_t& path) {
  ++tries_;
  if (path.status == path_t::FRONTIER) {
    const Eigen::Vector2d back_m = trail_m_.front();
    trail_m_.clear();
    return go(back_m, kNear_m, true);
  }
  if (wide_m_ > kWidest_m) return go(goal_m_, tolerance_m_, false);
  go(goal_m_, wide_m_, true);
  wide_m_ *= 2;
}

void Errand::has_looked() {
  looks_around_ = false;
  wide_m_ = 1.0;
  go(goal_m_, tolerance_m_, false);
}

void Errand::go(const Eigen::Vector2d& place_m, double tolerance_m, bool aside) {
  ++id_;
  place_m_ = place_m;
  near_m_ = tolerance_m;
  aside_ = aside;
  stuck_ = false;
}

void Errand::remember(const Eigen::Vector2d& believed_m) {
  if (!trail_m_.empty() && (trail_m_.back() - believed_m).norm() < kTrail_m) return;
  trail_m_.push_back(believed_m);
  if (trail_m_.size() > kBack + 1) trail_m_.pop_front();
}

}  // namespace floornav
