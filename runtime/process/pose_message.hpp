#pragma once

#include "floornav/pose_t.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// T_world_body of a POSE from the wire; throws std::invalid_argument for what is no pose within
/// kMaxPosition_m.
Pose body_pose(const pose_t& message);

}  // namespace floornav
