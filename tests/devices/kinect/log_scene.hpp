#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "runtime/geometry/pose.hpp"

namespace floornav {

/// What a log's drive looked like: its frames make a scene file, its poses stay here.
struct LogScene {
  struct BodyPose {
    std::int64_t utime_us = 0;
    Pose T_world_body;
  };
  int frames = 0;
  int period_us = 0;                ///< between frames
  std::int64_t first_utime_us = 0;  ///< of the first frame
  std::vector<BodyPose> poses;      ///< by time

  /// utime in the log of what a camera sees that plays the log there and back, so long after the first frame.
  [[nodiscard]] std::int64_t log_utime_us(std::int64_t since_first_us) const;
  /// The body there and then, interpolated.
  [[nodiscard]] Pose body_at(std::int64_t since_first_us) const;
};

/// Turns the first whole KINECT_CLOUD frames of a log into a scene that is played there and back, in counts
/// of 1 mm. Throws std::runtime_error for a log without clouds or poses.
LogScene write_log_scene(const std::filesystem::path& log, const std::filesystem::path& scene,
                         int max_frames);

}  // namespace floornav
