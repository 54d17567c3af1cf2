#pragma once

// An example: how a differential drive follows PATH. Needs floornav::lcmtypes only.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "floornav/path_t.hpp"

/// Pure pursuit of the newest PATH. All lengths in m, angles in rad, times in s on one monotonic clock.
class FollowPath {
 public:
  struct Command {
    double speed_mps = 0;
    double turn_radps = 0;
  };

  void accept(const floornav::path_t& path, double now_s) {
    path_ = path;
    expires_s_ = now_s + 1e-3 * path.valid_for_ms;  // counted from receipt, on our own clock
  }

  /// What to drive now, standing at (x, y) and heading for `heading`. Stands still without a valid path.
  [[nodiscard]] Command command(double x, double y, double heading, double now_s) const {
    const bool go = path_.status == floornav::path_t::FOLLOWING || path_.status == floornav::path_t::FRONTIER;
    if (!go || now_s >= expires_s_ || path_.points.empty()) return {};
    const std::size_t here = nearest(x, y);
    const auto& aim = path_.points[ahead(here, kLook_m)];
    const double dx = static_cast<double>(aim.x) - x, dy = static_cast<double>(aim.y) - y;
    const double distance = std::hypot(dx, dy);
    if (distance < kThere_m) return {};
    const double off = std::remainder(std::atan2(dy, dx) - heading, 2 * M_PI);
    if (std::abs(off) > kTurnFirst_rad) return {0, std::copysign(kTurn_radps, off)};
    // The speed of the point that comes next: that of the nearest one may lie behind, and is 0 at rest.
    const double speed = static_cast<double>(path_.points[ahead(here, kBrake_m)].speed);
    const double curvature = 2 * std::sin(off) / distance;
    return {std::max(speed, kCreep_mps), std::max(speed, kCreep_mps) * curvature};
  }

 private:
  static constexpr double kLook_m = 0.35, kBrake_m = 0.1, kThere_m = 0.03;
  static constexpr double kTurnFirst_rad = 0.8, kTurn_radps = 0.8, kCreep_mps = 0.03;

  [[nodiscard]] std::size_t nearest(double x, double y) const {
    const auto distance = [&](const auto& p) {
      return std::hypot(static_cast<double>(p.x) - x, static_cast<double>(p.y) - y);
    };
    const auto& points = path_.points;
    const auto it = std::min_element(points.begin(), points.end(),
                                     [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    return static_cast<std::size_t>(it - points.begin());
  }
  /// The first point at least `far` along the path from another.
  [[nodiscard]] std::size_t ahead(std::size_t i, double far) const {
    for (double gone = 0; i + 1 < path_.points.size() && gone < far; ++i) {
      const auto &a = path_.points[i], &b = path_.points[i + 1];
      gone += std::hypot(static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y));
    }
    return i;
  }

  floornav::path_t path_{};
  double expires_s_ = 0;
};
