#include "tools/import/ground_pose.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

namespace {

// sin of the pitch at which the image's top begins to tell the heading, and from which it alone does: 60 and
// 75 degrees
constexpr double kSteepFrom = 0.866;
constexpr double kSteepWhole = 0.966;
constexpr double kLeastLean = 0.05;

}  // namespace

std::optional<double> camera_heading(const Pose& T_world_camera) {
  const Eigen::Vector3d axis = T_world_camera.linear().col(2);
  const Eigen::Vector3d image_top = -T_world_camera.linear().col(1);
  const double down = -axis.z();
  const double steep = std::clamp((std::abs(down) - kSteepFrom) / (kSteepWhole - kSteepFrom), 0.0, 1.0);
  const Eigen::Vector2d ahead =
      (1 - steep) * axis.head<2>() + steep * std::copysign(1.0, down) * image_top.head<2>();
  if (ahead.norm() < kLeastLean) return std::nullopt;
  return std::atan2(ahead.y(), ahead.x());
}

Pose BodyUnderCamera::operator()(const Pose& T_world_camera) {
  heading_rad_ = camera_heading(T_world_camera).value_or(heading_rad_);
  Pose T_world_body = Pose::Identity();
  T_world_body.translate(
      Eigen::Vector3d(T_world_camera.translation().x(), T_world_camera.translation().y(), floor_z_m_));
  T_world_body.rotate(Eigen::AngleAxisd(heading_rad_, Eigen::Vector3d::UnitZ()));
  return T_world_body;
}

Pose mounted_sensor(double height_m, double pitch_rad, double roll_rad) {
  Eigen::Matrix3d body_from_level_camera;  // x right, y down, z forward -> x forward, y left, z up
  body_from_level_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Pose T_body_sensor = Pose::Identity();
  T_body_sensor.linear() = (Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(-roll_rad, Eigen::Vector3d::UnitX()))
                               .toRotationMatrix() *
                           body_from_level_camera;
  T_body_sensor.translation().z() = height_m;
  return T_body_sensor;
}

}  // namespace floornav
