#include "perception/surfels.hpp"

#include <cmath>
#include <numbers>

namespace floornav {

namespace {

constexpr float kReachSlack_m = 0.03F;

bool is_traversable(const Surfel& surfel, const SensorView& view, const RobotSettings& robot) {
  const Eigen::Vector3f from_body = (surfel.centroid_m - view.T_world_body.translation()).cast<float>();
  const double slope_deg =
      std::acos(std::clamp(static_cast<double>(surfel.normal.z()), -1.0, 1.0)) * 180.0 / std::numbers::pi;
  return slope_deg <= robot.max_slope_deg &&
         Reach(robot).holds(from_body.head<2>().norm(), from_body.z(), kReachSlack_m);
}

Surfel surfel_of(const SectionPlane& found, const PlaneSums& sums, int section, const SensorView& view,
                 const RobotSettings& robot) {
  Surfel surfel;
  surfel.centroid_m = view.T_world_sensor * Eigen::Vector3d(sums.position / sums.points);
  surfel.normal =
      (view.T_world_sensor.linear() * found.plane.normal().cast<double>()).normalized().cast<float>();
  surfel.radius_m = static_cast<float>(std::sqrt(sums.area_m2 / std::numbers::pi));
  surfel.rms_m = static_cast<float>(std::sqrt(sums.squared_distance / sums.points));
  surfel.points = sums.points;
  surfel.section = static_cast<std::int16_t>(section);
  surfel.dominant = found.dominant;
  surfel.traversable = is_traversable(surfel, view, robot);
  return surfel;
}

}  // namespace

void make_surfels(const RoiCloud& cloud, int section, std::span<const SectionPlane> planes,
                  std::span<const std::int16_t> label, const SensorView& view, const RobotSettings& robot,
                  std::vector<PlaneSums>& sums, std::vector<Surfel>& surfels) {
  sums.assign(planes.size(), {});
  for (std::size_t k = 0; k < planes.size(); ++k) sums[k].plane_distance_m = planes[k].plane.distance_m();
  const float pixel_area = 1.0F / (view.camera.fx * view.camera.fy);
  for (std::int32_t p = cloud.section_begin(section);
       p < cloud.section_end[static_cast<std::size_t>(section)]; ++p) {
    const auto i = static_cast<std::size_t>(p);
    if (label[i] < 0) continue;
    const auto index = static_cast<std::size_t>(label[i]);
    const InverseDepthPlane& plane = planes[index].plane;
    const float inverse_depth = plane.inverse_depth(cloud.ray_x[i], cloud.ray_y[i]);
    const float depth = 1.0F / inverse_depth;
    // The plane's distance times its inverse depth along a ray is the cosine that the ray has with it.
    const float facing = inverse_depth * sums[index].plane_distance_m;
    const float distance = (cloud.z[i] - depth) * facing;
    PlaneSums& sum = sums[index];
    sum.position += (depth * Eigen::Vector3f(cloud.ray_x[i], cloud.ray_y[i], 1.0F)).cast<double>();
    sum.squared_distance += static_cast<double>(distance * distance);
    sum.area_m2 += static_cast<double>(depth * depth * pixel_area / facing);
    ++sum.points;
  }
  surfels.clear();
  for (std::size_t k = 0; k < planes.size(); ++k)
    surfels.push_back(surfel_of(planes[k], sums[k], section, view, robot));
}

}  // namespace floornav
