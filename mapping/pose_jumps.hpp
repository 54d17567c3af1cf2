#pragma once

#include <cstdint>
#include <optional>

#include "runtime/geometry/pose.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Watches the body's pose for jumps that no drive explains: after one, nothing in the map is where the pose
/// says.
class PoseJumps {
 public:
  explicit PoseJumps(const RobotSettings& robot) : robot_(robot) {}

  enum class Move {
    kDrive,         ///< as a robot moves
    kJump,          ///< more than 1.5 times what its limits allow in that time plus 0.1 m or 0.3 rad
    kOld,           ///< not newer than the one before: left out
    kClockStepped,  ///< utime went back by more than a second: the sender's clock was set, nothing to compare
                    ///< with
  };
  /// Takes the next pose, and says how it follows from the one before.
  Move take(std::int64_t utime_us, const Pose& T_world_body);

 private:
  struct Stamped {
    std::int64_t utime_us;
    Pose T_world_body;
  };
  RobotSettings robot_;
  std::optional<Stamped> last_;
};

}  // namespace floornav
