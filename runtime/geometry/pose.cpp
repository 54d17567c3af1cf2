#include "runtime/geometry/pose.hpp"

#include <cmath>
#include <stdexcept>

namespace floornav {

Pose pose_from_arrays(const double position[3], const double quaternion_wxyz[4]) {
  const Eigen::Quaterniond q(quaternion_wxyz[0], quaternion_wxyz[1], quaternion_wxyz[2], quaternion_wxyz[3]);
  const Eigen::Vector3d p(position[0], position[1], position[2]);
  const double norm = q.norm();
  if (!std::isfinite(norm) || norm < 1e-6) throw std::invalid_argument("pose has no valid quaternion");
  if (!p.allFinite()) throw std::invalid_argument("pose has a position that is not finite");
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = p;
  return pose;
}

void pose_to_arrays(const Pose& pose, double position[3], double quaternion_wxyz[4]) {
  Eigen::Quaterniond q(pose.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  quaternion_wxyz[0] = q.w();
  quaternion_wxyz[1] = q.x();
  quaternion_wxyz[2] = q.y();
  quaternion_wxyz[3] = q.z();
  Eigen::Map<Eigen::Vector3d>{position} = pose.translation();
}

double heading_of(const Pose& pose) {
  return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
}

Pose interpolate(const Pose& a, const Pose& b, double fraction) {
  Pose pose = Pose::Identity();
  pose.linear() =
      Eigen::Quaterniond(a.linear()).slerp(fraction, Eigen::Quaterniond(b.linear())).toRotationMatrix();
  pose.translation() = a.translation() + fraction * (b.translation() - a.translation());
  return pose;
}

}  // namespace floornav
