#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "runtime/geometry/pose.hpp"

namespace floornav {

/// The body's poses of the last few seconds, to look one up at the time of a frame.
class PoseHistory {
 public:
  explicit PoseHistory(std::int64_t span_us = 5'000'000) : span_us_(span_us) {}

  /// Adds the pose of the body in the local frame. False, and nothing changes, where `utime_us` is not newer
  /// than the newest one held.
  bool insert(std::int64_t utime_us, const Pose& T_world_body);

  /// The pose at a time between two held ones (or exactly at one); nothing where no two bracket it.
  [[nodiscard]] std::optional<Pose> at(std::int64_t utime_us) const;

  /// utime of the newest pose, where there is one.
  [[nodiscard]] std::optional<std::int64_t> newest_utime() const;
  [[nodiscard]] std::optional<Pose> newest() const;

  /// Forgets everything: the sender's clock has stepped.
  void clear() { poses_.clear(); }

 private:
  struct Stamped {
    std::int64_t utime_us;
    Pose T_world_body;
  };
  std::int64_t span_us_;
  std::deque<Stamped> poses_;
};

}  // namespace floornav
