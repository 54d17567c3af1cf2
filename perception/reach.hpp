#pragma once

#include <cmath>
#include <numbers>

#include "runtime/geometry/robot.hpp"

namespace floornav {

/// What floor the robot can come to from where it stands: at a horizontal distance it may have risen or
/// fallen by a step and by its steepest slope.
class Reach {
 public:
  explicit Reach(const RobotSettings& robot)
      : step_m_(static_cast<float>(robot.max_step_m)),
        slope_(static_cast<float>(std::tan(robot.max_slope_deg * std::numbers::pi / 180.0))) {}

  /// `height_m` above the body's origin, level; `slack_m` for noise and calibration.
  [[nodiscard]] bool holds(float distance_m, float height_m, float slack_m) const {
    return std::abs(height_m) <= step_m_ + slope_ * distance_m + slack_m;
  }

  [[nodiscard]] float step_m() const { return step_m_; }
  [[nodiscard]] float slope() const { return slope_; }  ///< vertical metres a horizontal one

 private:
  float step_m_;
  float slope_;
};

}  // namespace floornav
