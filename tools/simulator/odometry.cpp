#include "tools/simulator/odometry.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace floornav {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

/// A turn by a small vector of angles (rad).
Eigen::Matrix3d small_turn(const Eigen::Vector3d& angles) {
  return Eigen::Quaterniond(1.0, 0.5 * angles.x(), 0.5 * angles.y(), 0.5 * angles.z())
      .normalized()
      .toRotationMatrix();
}

Eigen::Vector3d normal_vector(RandomStream& random, double sigma) {
  const double x = random.normal();
  const double y = random.normal();
  return sigma * Eigen::Vector3d(x, y, random.normal());
}

}  // namespace

Odometry::Odometry(const PoseNoise& noise, std::uint64_t seed) : noise_(noise), random_(seed) {}

void Odometry::advance(const Pose& T_world_body) {
  Pose step = last_true_.inverse() * T_world_body;
  const double distance_m = step.translation().norm();
  step.translation() *= 1.0 + noise_.drift_per_m;
  const double turn = noise_.drift_deg_per_m * kRadPerDeg * std::sqrt(distance_m) * random_.normal();
  drifted_ = drifted_ * step;
  // about the vertical of the world: the accelerometer keeps the rest level
  drifted_.linear() = small_turn({0, 0, turn}) * drifted_.linear();
  drifted_.translation().z() = T_world_body.translation().z();
}

Pose Odometry::measure(const Pose& T_world_body) {
  const bool drifts = noise_.drift_per_m != 0 || noise_.drift_deg_per_m != 0;
  if (!drifts || !started_)
    drifted_ = T_world_body;
  else
    advance(T_world_body);
  started_ = true;
  last_true_ = T_world_body;
  if (noise_.position_m == 0 && noise_.angle_deg == 0) return drifted_;
  Pose measured = drifted_;
  measured.translation() += normal_vector(random_, noise_.position_m);
  measured.linear() = drifted_.linear() * small_turn(normal_vector(random_, noise_.angle_deg * kRadPerDeg));
  return measured;
}

}  // namespace floornav
