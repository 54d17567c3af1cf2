#include "tools/import/frame_place.hpp"

#include <numbers>

#include "tools/import/ground_pose.hpp"

namespace floornav {

Pose sensor_pose(const FixedMounting& mounting) {
  constexpr double kRadPerDeg = std::numbers::pi / 180;
  return mounted_sensor(mounting.height_m, mounting.pitch_deg * kRadPerDeg, mounting.roll_deg * kRadPerDeg);
}

Pose place_of(std::int64_t frame, const FixedMounting& mounting) {
  Pose T_world_body = Pose::Identity();
  T_world_body.translation() =
      mounting.spacing_m * Eigen::Vector3d(static_cast<double>(frame % FixedMounting::per_row),
                                           -static_cast<double>(frame / FixedMounting::per_row), 0);
  return T_world_body;
}

}  // namespace floornav
