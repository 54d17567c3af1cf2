#pragma once

#include <string>

#include "runtime/geometry/robot.hpp"
#include "tools/simulate/path_follower.hpp"
#include "tools/simulator/shapes.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {

/// A differential drive on a true floor: obeys its commands within its accelerations, and knows when it hits
/// something.
class DriveBase {
 public:
  DriveBase(const RobotSettings& robot, const PlanarState& start) : robot_(robot), state_(start) {}

  void move(const DriveCommand& command, double step_s);

  [[nodiscard]] const PlanarState& state() const { return state_; }
  [[nodiscard]] double speed_mps() const { return speed_mps_; }
  [[nodiscard]] double turn_radps() const { return turn_radps_; }
  [[nodiscard]] double travelled_m() const { return travelled_m_; }

  /// What is wrong with where it stands now, against the true world: empty, or what its rectangle of length x
  /// width touches, or what a wheel has climbed or fallen down since the last call.
  std::string trouble(const Shapes& world);
  /// The same of what its rectangle touches alone.
  [[nodiscard]] std::string touched(const Shapes& world) const;

  static constexpr double kLength_m = 0.83;  ///< MobileRobots PowerBot
  static constexpr double kWidth_m = 0.63;

 private:
  std::string stepped(const Shapes& world);

  RobotSettings robot_;
  PlanarState state_;
  double speed_mps_ = 0;
  double turn_radps_ = 0;
  double travelled_m_ = 0;
  bool wheels_known_ = false;
  double wheel_z_m_[4] = {};
};

}  // namespace floornav
