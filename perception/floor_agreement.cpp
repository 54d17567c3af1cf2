#include "perception/floor_agreement.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace floornav {

namespace {

/// Pixels this close together, each way, count as one measurement.
constexpr double kAlike_px = 24.0;
/// 1 sigma between the tilts of a section's floor and the common one, rad (0.3 degrees).
constexpr double kTiltSigma = 0.005;
/// Contradiction: 1 % of the chi square distribution with two degrees of freedom.
constexpr double kContradiction = 9.2;
/// Arm of the cross of points that stands for the common tilt, in distances of the sensor from the plane.
constexpr float kArm = 0.1F;

/// What says that a plane through `center` has the tilt of `common`: points of it around the centre, as
/// certain as kTiltSigma makes them.
PlaneFit tilt_of(const InverseDepthPlane& common, const Eigen::Vector3f& center) {
  const Eigen::Vector3f normal = common.normal();
  const float distance = -normal.dot(center);
  const Eigen::Vector3f side = normal.unitOrthogonal();
  const Eigen::Vector3f other = normal.cross(side);
  PlaneFit fit;
  for (const Eigen::Vector3f& direction : {side, Eigen::Vector3f(-side), other, Eigen::Vector3f(-other)}) {
    const Eigen::Vector3f p = center + kArm * distance * direction;
    if (!(p.z() > 0.0F)) continue;
    // Moved by s along the normal, the plane's inverse depth changes by s / (z distance).
    const double certainty = static_cast<double>(p.z()) / (static_cast<double>(kArm) * kTiltSigma);
    fit.add(p.x() / p.z(), p.y() / p.z(), 1.0F / p.z(), static_cast<float>(0.5 * certainty * certainty));
  }
  return fit;
}

}  // namespace

InverseDepthPlane FloorAgreement::settle(const PlaneFit& floor, const InverseDepthPlane& plane) const {
  const auto common = common_.solve();
  if (!common) return plane;
  PlaneFit own = floor;
  own *= 1.0 / (kAlike_px * kAlike_px);
  const Eigen::Vector2f ray = floor.mean_ray();
  const float depth = 1.0F / plane.inverse_depth(ray.x(), ray.y());
  if (!(depth > 0.0F)) return plane;
  const PlaneFit tilt = tilt_of(*common, depth * Eigen::Vector3f(ray.x(), ray.y(), 1.0F));
  PlaneFit both = own;
  both += tilt;
  const auto settled = both.solve();
  if (!settled) return plane;
  const double contradiction = both.cost(*settled) - own.cost(plane);
  return contradiction < kContradiction ? *settled : plane;
}

}  // namespace floornav
