#include "tools/simulator/vehicle.hpp"

#include <Eigen/Geometry>

#include "tools/simulator/surface.hpp"

namespace floornav {
namespace {

constexpr int kSamples = 8;

/// Mean height of the floor under a wheel.
double wheel_height(const Shapes& shapes, const Eigen::Vector2d& hub, const Eigen::Vector2d& ahead,
                    double reach_m) {
  double sum = 0;
  for (int i = 0; i < kSamples; ++i)
    sum += surface_at(shapes, hub + (2.0 * (i + 0.5) / kSamples - 1.0) * reach_m * ahead).z_m;
  return sum / kSamples;
}

}  // namespace

Pose body_on_floor(const Shapes& shapes, const PlanarState& state, const Undercarriage& wheels) {
  const Eigen::Vector2d ahead = state.ahead;
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const auto height = [&](double x, double y) {
    const Eigen::Vector2d hub =
        state.position_m + 0.5 * wheels.wheelbase_m * x * ahead + 0.5 * wheels.track_m * y * left;
    return wheel_height(shapes, hub, ahead, wheels.wheel_reach_m);
  };
  const double front_left = height(1, 1);
  const double front_right = height(1, -1);
  const double rear_left = height(-1, 1);
  const double rear_right = height(-1, -1);
  const double rise = 0.5 * (front_left + front_right - rear_left - rear_right) / wheels.wheelbase_m;
  const double bank = 0.5 * (front_left + rear_left - front_right - rear_right) / wheels.track_m;
  const Eigen::Vector3d x = Eigen::Vector3d(ahead.x(), ahead.y(), rise).normalized();
  const Eigen::Vector3d z = x.cross(Eigen::Vector3d(left.x(), left.y(), bank)).normalized();
  Pose pose = Pose::Identity();
  pose.linear() << x, z.cross(x), z;
  pose.translation() << state.position_m, 0.25 * (front_left + front_right + rear_left + rear_right);
  return pose;
}

}  // namespace floornav
