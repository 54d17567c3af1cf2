#include "tools/replay/frame_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace floornav {

namespace {

constexpr double kSameFloorDistance_m = 0.03;
constexpr double kSameFloorAngle_deg = 4;
constexpr double kDegPerRad = 180 / std::numbers::pi;

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * kDegPerRad;
}

bool is_floor(const Surfel& surfel) {
  return surfel.dominant && surfel.traversable;
}

bool agrees(const Surfel& surfel, const Surfel& with) {
  const Eigen::Vector3d normal = with.normal.cast<double>();
  return std::abs(normal.dot(surfel.centroid_m - with.centroid_m)) < kSameFloorDistance_m &&
         angle_deg(normal, surfel.normal.cast<double>()) < kSameFloorAngle_deg;
}

FrameFloor no_floor() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {0, kNone, kNone, kNone, kNone, kNone};
}

}  // namespace

FrameFloor floor_of(const std::vector<Surfel>& surfels, const Pose& T_world_sensor) {
  const Surfel* largest = nullptr;
  for (const Surfel& surfel : surfels)
    if (is_floor(surfel) && (largest == nullptr || surfel.points > largest->points)) largest = &surfel;
  if (largest == nullptr) return no_floor();

  FrameFloor floor;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Surfel& surfel : surfels) {
    if (!is_floor(surfel) || !agrees(surfel, *largest)) continue;
    const Eigen::Vector3d n = surfel.normal.cast<double>();
    floor.points += surfel.points;
    normal += surfel.points * n;
    floor.height_m += surfel.points * surfel.centroid_m.z();
    floor.camera_height_m += surfel.points * n.dot(T_world_sensor.translation() - surfel.centroid_m);
  }
  normal.normalize();
  floor.height_m /= floor.points;
  floor.camera_height_m /= floor.points;
  floor.tilt_deg = angle_deg(normal, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d up = T_world_sensor.linear().transpose() * normal;  // x right, y down, z forward
  floor.camera_pitch_deg = std::asin(std::clamp(-up.z(), -1.0, 1.0)) * kDegPerRad;
  floor.camera_roll_deg = std::atan2(up.x(), -up.y()) * kDegPerRad;
  return floor;
}

}  // namespace floornav
