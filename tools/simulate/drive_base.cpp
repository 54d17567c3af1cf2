#include "tools/simulate/drive_base.hpp"

#include <algorithm>
#include <cmath>

#include "tools/simulator/surface.hpp"

namespace floornav {
namespace {

constexpr double kTurnAcceleration_radps2 = 3.0;
constexpr double kSample_m = 0.05;
constexpr double kStepSlack_m = 0.003;  ///< what a slope adds between two looks

double towards(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

Eigen::Vector2d left_of(const Eigen::Vector2d& ahead) {
  return {-ahead.y(), ahead.x()};
}

}  // namespace

void DriveBase::move(const DriveCommand& command, double step_s) {
  speed_mps_ = towards(speed_mps_, command.speed_mps, robot_.max_acceleration_mps2 * step_s);
  turn_radps_ = towards(turn_radps_, command.turn_radps, kTurnAcceleration_radps2 * step_s);
  const Eigen::Vector2d before = state_.ahead;
  state_.ahead = (before + turn_radps_ * step_s * left_of(before)).normalized();
  state_.position_m += speed_mps_ * step_s * (before + state_.ahead).normalized();
  travelled_m_ += std::fabs(speed_mps_) * step_s;
}

std::string DriveBase::touched(const Shapes& world) const {
  const Undercarriage hubs{.wheel_reach_m = 0.0};  // a tyre beside an edge has not dropped yet
  const Pose T_world_body = body_on_floor(world, state_, hubs);
  const int columns = static_cast<int>(std::ceil(kLength_m / kSample_m));
  const int rows = static_cast<int>(std::ceil(kWidth_m / kSample_m));
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const Eigen::Vector3d under =
          T_world_body * Eigen::Vector3d((static_cast<double>(i) / columns - 0.5) * kLength_m,
                                         (static_cast<double>(j) / rows - 0.5) * kWidth_m, 0);
      const SurfacePoint surface = surface_at(world, under.head<2>());
      if (surface.z_m > under.z() + robot_.ground_clearance_m) return "hit something";
      if (surface.z_m + surface.clearance_m < under.z() + robot_.height_m) return "hit something above";
    }
  }
  return {};
}

std::string DriveBase::stepped(const Shapes& world) {
  const Undercarriage wheels;
  std::string trouble;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d hub = state_.position_m +
                                ((k & 1) != 0 ? 0.5 : -0.5) * wheels.wheelbase_m * state_.ahead +
                                ((k & 2) != 0 ? 0.5 : -0.5) * wheels.track_m * left_of(state_.ahead);
    const double z_m = surface_at(world, hub).z_m;
    const double change_m = z_m - wheel_z_m_[k];
    if (wheels_known_ && std::fabs(change_m) > robot_.max_step_m + kStepSlack_m)
      trouble = change_m > 0 ? "drove up a step" : "drove over an edge";
    wheel_z_m_[k] = z_m;
  }
  wheels_known_ = true;
  return trouble;
}

std::string DriveBase::trouble(const Shapes& world) {
  const std::string step = stepped(world);
  return step.empty() ? touched(world) : step;
}

}  // namespace floornav
