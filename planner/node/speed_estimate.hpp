#pragma once

#include <cstdint>
#include <deque>

#include "runtime/geometry/pose.hpp"

namespace floornav {

/// How quickly the robot moves, from its poses: not every sender of POSE fills in `vel`.
class SpeedEstimate {
 public:
  void add(std::int64_t utime_us, const Pose& T_world_body) {
    if (!poses_.empty() && utime_us <= poses_.back().utime_us) poses_.clear();
    poses_.push_back({utime_us, T_world_body.translation().head<2>()});
    while (poses_.size() > 2 && utime_us - poses_[1].utime_us >= kWindow_us) poses_.pop_front();
  }

  /// Over the last fifth of a second; 0 while there is no more than one pose.
  [[nodiscard]] double mps() const {
    if (poses_.size() < 2) return 0.0;
    const Placed &first = poses_.front(), &last = poses_.back();
    return (last.place_m - first.place_m).norm() /
           (static_cast<double>(last.utime_us - first.utime_us) * 1e-6);
  }

 private:
  static constexpr std::int64_t kWindow_us = 200'000;
  struct Placed {
    std::int64_t utime_us;
    Eigen::Vector2d place_m;
  };
  std::deque<Placed> poses_;
};

}  // namespace floornav
