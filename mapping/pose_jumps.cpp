#include "mapping/pose_jumps.hpp"

#include <utility>

namespace floornav {

PoseJumps::Move PoseJumps::take(std::int64_t utime_us, const Pose& T_world_body) {
  constexpr std::int64_t kClockStep_us = 1'000'000;
  constexpr double kFactor = 1.5;
  constexpr double kSlack_m = 0.1;
  constexpr double kSlack_rad = 0.3;
  const bool clock_stepped = last_ && utime_us < last_->utime_us - kClockStep_us;
  if (last_ && utime_us <= last_->utime_us && !clock_stepped) return Move::kOld;
  const std::optional<Stamped> before = std::exchange(last_, Stamped{utime_us, T_world_body});
  if (clock_stepped) return Move::kClockStepped;
  if (!before) return Move::kDrive;
  const double passed_s = 1e-6 * static_cast<double>(utime_us - before->utime_us);
  const double moved_m = (T_world_body.translation() - before->T_world_body.translation()).norm();
  const Eigen::Quaterniond from(before->T_world_body.linear());
  const double turned_rad = from.angularDistance(Eigen::Quaterniond(T_world_body.linear()));
  const bool drive = moved_m <= kFactor * robot_.max_speed_mps * passed_s + kSlack_m &&
                     turned_rad <= kFactor * robot_.max_turn_rate_radps * passed_s + kSlack_rad;
  return drive ? Move::kDrive : Move::kJump;
}

}  // namespace floornav
