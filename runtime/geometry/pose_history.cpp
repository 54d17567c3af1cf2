#include "runtime/geometry/pose_history.hpp"

#include <algorithm>

namespace floornav {

bool PoseHistory::insert(std::int64_t utime_us, const Pose& T_world_body) {
  if (!poses_.empty() && utime_us <= poses_.back().utime_us) return false;
  poses_.push_back({utime_us, T_world_body});
  while (poses_.front().utime_us < utime_us - span_us_) poses_.pop_front();
  return true;
}

std::optional<Pose> PoseHistory::at(std::int64_t utime_us) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), utime_us,
                                      [](const Stamped& s, std::int64_t t) { return s.utime_us < t; });
  if (after == poses_.end()) return std::nullopt;
  if (after->utime_us == utime_us) return after->T_world_body;
  if (after == poses_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double fraction = static_cast<double>(utime_us - before->utime_us) /
                          static_cast<double>(after->utime_us - before->utime_us);
  return interpolate(before->T_world_body, after->T_world_body, fraction);
}

std::optional<std::int64_t> PoseHistory::newest_utime() const {
  if (poses_.empty()) return std::nullopt;
  return poses_.back().utime_us;
}

std::optional<Pose> PoseHistory::newest() const {
  if (poses_.empty()) return std::nullopt;
  return poses_.back().T_world_body;
}

}  // namespace floornav
