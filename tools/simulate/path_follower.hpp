#pragma once

#include <optional>
#include <vector>

#include "floornav/path_t.hpp"
#include "runtime/geometry/robot.hpp"
#include "runtime/process/time.hpp"
#include "tools/simulator/trajectory.hpp"

namespace floornav {

/// What a differential drive is asked for.
struct DriveCommand {
  double speed_mps = 0;
  double turn_radps = 0;
};

/// A simple controller: pure pursuit of the newest PATH at the speeds that it allows; stands still without a
/// valid one. Where a path ends at the frontier of what was seen, or there is none since the way is blocked,
/// the robot turns once around itself, towards the path's heading first, so that its sensor sees more; one
/// that is no circle only where the last PATH had room for its circle.
class PathFollower {
 public:
  explicit PathFollower(const RobotSettings& robot) : robot_(robot) {}

  void accept(const path_t& path, Micros now);
  /// `believed` is the robot's place by its odometry, `speed_mps` what it drives.
  [[nodiscard]] DriveCommand command(const PlanarState& believed, double speed_mps, Micros now);

  /// Comes to rest and turns once around itself; nothing once it has, or where there is no room for it.
  [[nodiscard]] std::optional<DriveCommand> look_around(const PlanarState& believed, double speed_mps);

  [[nodiscard]] const std::optional<path_t>& path() const { return path_; }

 private:
  [[nodiscard]] bool is_looking() const;
  [[nodiscard]] bool has_room_to_turn(const Eigen::Vector2d& place_m) const;

  RobotSettings robot_;
  std::optional<path_t> path_;
  std::vector<path_point_t> last_points_;  ///< of the last path that had any
  Micros received_{0};

  /// The last look around: where, which way, how far, and the heading when it was last asked for.
  struct Look {
    Eigen::Vector2d place_m;
    Eigen::Vector2d ahead;
    double direction = 1;
    double turned_rad = 0;
  };
  std::optional<Look> look_;
};

}  // namespace floornav
