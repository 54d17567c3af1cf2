#include "drivers/camera/mounting.hpp"

#include <numbers>

namespace floornav {

Pose sensor_in_body(const MountingSettings& m) {
  constexpr double kDegree = std::numbers::pi / 180;
  Eigen::Matrix3d level;  // columns: the sensor's right, down and forward in the body frame
  level << 0, 0, 1,       //
      -1, 0, 0,           //
      0, -1, 0;
  const Eigen::AngleAxisd yaw(m.yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(m.pitch_deg * kDegree, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd roll(m.roll_deg * kDegree, Eigen::Vector3d::UnitX());
  Pose T_body_sensor = Pose::Identity();
  T_body_sensor.linear() = (yaw * pitch * roll).toRotationMatrix() * level;
  T_body_sensor.translation() = Eigen::Vector3d(m.x_m, m.y_m, m.height_m);
  return T_body_sensor;
}

}  // namespace floornav
