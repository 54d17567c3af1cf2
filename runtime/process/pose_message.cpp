#include "runtime/process/pose_message.hpp"

#include <stdexcept>

namespace floornav {

Pose body_pose(const pose_t& message) {
  const Pose T_world_body = pose_from_arrays(message.pos, message.orientation);
  if (T_world_body.translation().cwiseAbs().maxCoeff() > kMaxPosition_m)
    throw std::invalid_argument("pose: absurd position");
  return T_world_body;
}

}  // namespace floornav
