#pragma once

#include <Eigen/Geometry>

namespace floornav {

/// A rigid transform; `T_a_b` maps coordinates in frame b to coordinates in frame a. Metres.
using Pose = Eigen::Isometry3d;

/// A message that tells of a place farther than this from the world's origin is refused at every node's edge,
/// m.
constexpr double kMaxPosition_m = 1e5;

/// From a position (m) and a quaternion w x y z as messages carry it. Any non-zero finite quaternion is
/// normalised; throws std::invalid_argument for a zero or non-finite one or a non-finite position.
Pose pose_from_arrays(const double position[3], const double quaternion_wxyz[4]);

/// The inverse of pose_from_arrays.
void pose_to_arrays(const Pose& pose, double position[3], double quaternion_wxyz[4]);

/// Heading of the pose's x axis in the horizontal plane, rad in (-pi, pi].
double heading_of(const Pose& pose);

/// Position interpolated linearly, rotation along the great arc; `fraction` 0 gives a, 1 gives b.
Pose interpolate(const Pose& a, const Pose& b, double fraction);

}  // namespace floornav
