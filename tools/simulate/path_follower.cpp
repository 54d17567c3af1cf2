#include "tools/simulate/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floornav {
namespace {

constexpr double kLookAhead_m = 0.25;
constexpr double kLookAhead_s = 0.5;
constexpr double kTurnGain_perS = 2.0;
constexpr double kSpeedLook_m = 0.1;  ///< the speed that holds there is driven here
constexpr double kSlowest_mps = 0.02;
constexpr double kAtEnd_m = 0.1;
constexpr double kBeyondEnd_m = 0.3;  ///< a look around is broken off for a path as long as this
constexpr double kLookTurn_radps = 0.6;
constexpr double kSamePlace_m = 0.15;

Eigen::Vector2d point_of(const path_t& path, std::size_t i) {
  return {static_cast<double>(path.points[i].x), static_cast<double>(path.points[i].y)};
}

/// A place on the path: on the piece that ends at point `next`, `from_next_m` before it.
struct PlaceOnPath {
  std::size_t next = 0;
  double from_next_m = 0;
};

PlaceOnPath nearest_place(const path_t& path, const Eigen::Vector2d& position) {
  PlaceOnPath nearest{0, 0};
  double best = (point_of(path, 0) - position).squaredNorm();
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Eigen::Vector2d a = point_of(path, i - 1);
    const Eigen::Vector2d piece = point_of(path, i) - a;
    const double length = piece.norm();
    if (length < 1e-9) continue;
    const double along = std::clamp((position - a).dot(piece) / length, 0.0, length);
    const double distance = (a + along / length * piece - position).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    nearest = {i, length - along};
  }
  return nearest;
}

/// Goes on along the path; `speed_mps` is what holds there.
struct Ahead {
  Eigen::Vector2d position;
  double speed_mps;
};
Ahead go_on(const path_t& path, PlaceOnPath place, double distance_m) {
  std::size_t i = place.next;
  double left = place.from_next_m;
  while (distance_m > left && i + 1 < path.points.size()) {
    distance_m -= left;
    left = (point_of(path, i + 1) - point_of(path, i)).norm();
    ++i;
  }
  if (i == 0) return {point_of(path, 0), static_cast<double>(path.points[0].speed)};
  const Eigen::Vector2d back = point_of(path, i - 1) - point_of(path, i);
  const double share = back.norm() > 1e-9 ? std::max(0.0, left - distance_m) / back.norm() : 0.0;
  const double speed = (1.0 - share) * static_cast<double>(path.points[i].speed) +
                       share * static_cast<double>(path.points[i - 1].speed);
  return {point_of(path, i) + share * back, speed};
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether more must be seen before the robot can go on.
bool must_look(const path_t& path, const Eigen::Vector2d& position, double at_end_m) {
  if (path.status == path_t::NO_PATH || path.status == path_t::GOAL_BLOCKED) return true;
  if (path.status != path_t::FRONTIER) return false;
  return path.points.empty() || (point_of(path, path.points.size() - 1) - position).norm() < at_end_m;
}

}  // namespace

void PathFollower::accept(const path_t& path, Micros now) {
  path_ = path;
  if (!path.points.empty()) last_points_ = path.points;
  received_ = now;
}

bool PathFollower::is_looking() const {
  return look_ && std::fabs(look_->turned_rad) > 0 && std::fabs(look_->turned_rad) < 2.0 * std::numbers::pi;
}

bool PathFollower::has_room_to_turn(const Eigen::Vector2d& place_m) const {
  if (robot_.footprint.empty()) return true;
  return std::any_of(last_points_.begin(), last_points_.end(), [&](const path_point_t& p) {
    const Eigen::Vector2d there(static_cast<double>(p.x), static_cast<double>(p.y));
    const double off_m = (there - place_m).norm();
    return off_m < kSamePlace_m && static_cast<double>(p.clearance) >= robot_.radius_m + off_m;
  });
}

std::optional<DriveCommand> PathFollower::look_around(const PlanarState& believed, double speed_mps) {
  if (speed_mps > kSlowest_mps) return DriveCommand{};
  if (!has_room_to_turn(believed.position_m)) return std::nullopt;
  if (!look_ || (believed.position_m - look_->place_m).norm() > kSamePlace_m) {
    double side = 0;
    if (!path_->points.empty()) {
      const auto heading = static_cast<double>(path_->points.back().heading);
      side = cross(believed.ahead, {std::cos(heading), std::sin(heading)});
    }
    look_ = {believed.position_m, believed.ahead, side < 0 ? -1.0 : 1.0, 0.0};
  }
  look_->turned_rad += std::atan2(cross(look_->ahead, believed.ahead), look_->ahead.dot(believed.ahead));
  look_->ahead = believed.ahead;
  if (std::fabs(look_->turned_rad) >= 2.0 * std::numbers::pi) return std::nullopt;
  return DriveCommand{0.0, look_->direction * std::min(kLookTurn_radps, robot_.max_turn_rate_radps)};
}

DriveCommand PathFollower::command(const PlanarState& believed, double speed_mps, Micros now) {
  if (!path_) return {};
  if (now - received_ > std::chrono::milliseconds(path_->valid_for_ms)) return {};
  if (must_look(*path_, believed.position_m, is_looking() ? kBeyondEnd_m : kAtEnd_m))
    return look_around(believed, speed_mps).value_or(DriveCommand{});
  if (path_->status != path_t::FOLLOWING && path_->status != path_t::FRONTIER) return {};
  if (is_looking()) look_.reset();
  if (path_->points.empty()) return {};
  const PlaceOnPath here = nearest_place(*path_, believed.position_m);
  const Eigen::Vector2d target = go_on(*path_, here, kLookAhead_m + kLookAhead_s * speed_mps).position;
  const Eigen::Vector2d way = target - believed.position_m;
  const double x = believed.ahead.dot(way);
  const double y = cross(believed.ahead, way);
  if (way.norm() < 0.02) return {};
  if (x < std::fabs(y)) {  // more than 45 degrees aside: turn on the spot
    return {0.0, std::copysign(robot_.max_turn_rate_radps * 0.6, y)};
  }
  const double curvature = 2.0 * y / way.squaredNorm();
  double speed = std::min(go_on(*path_, here, kSpeedLook_m).speed_mps, robot_.max_speed_mps);
  if (std::fabs(curvature) * speed > robot_.max_turn_rate_radps)
    speed = robot_.max_turn_rate_radps / std::fabs(curvature);
  if (speed < kSlowest_mps) return {0.0, kTurnGain_perS * y / way.norm()};
  return {speed, curvature * speed};
}

}  // namespace floornav
