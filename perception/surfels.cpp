#include "perception/surfels.hpp"

#include <algorithm>
#include <array>
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

/// What some neighbouring points of one plane add to its sums.
struct Terms {
  static constexpr std::int32_t kMost = 64;
  std::array<float, kMost> x, y, z, squared_distance, cubed_depth;

  /// A loop that compilers make vectors of.
  void work_out(const RoiCloud& cloud, std::int32_t begin, std::int32_t end, const InverseDepthPlane& plane,
                float plane_distance_m) {
    const auto first = static_cast<std::size_t>(begin);
    const auto count = static_cast<std::size_t>(end - begin);
    const float* const ray_x = cloud.ray_x.data() + first;
    const float* const ray_y = cloud.ray_y.data() + first;
    const float* const measured_z = cloud.z.data() + first;
    for (std::size_t i = 0; i < count; ++i) {
      const float inverse_depth = plane.inverse_depth(ray_x[i], ray_y[i]);
      const float depth = 1.0F / inverse_depth;
      // The plane's distance times its inverse depth along a ray is the cosine that the ray has with it.
      const float distance = (measured_z[i] - depth) * inverse_depth * plane_distance_m;
      x[i] = depth * ray_x[i];
      y[i] = depth * ray_y[i];
      z[i] = depth;
      squared_distance[i] = distance * distance;
      cubed_depth[i] = depth * depth * depth;
    }
  }
};

/// Adds neighbouring points of one plane.
void add_run(const RoiCloud& cloud, std::int32_t begin, std::int32_t end, const InverseDepthPlane& plane,
             float pixel_area, PlaneSums& total) {
  double x = 0.0, y = 0.0, z = 0.0, squared_distance = 0.0, cubed_depth = 0.0;
  Terms terms;
  for (std::int32_t p = begin; p < end; p += Terms::kMost) {
    const std::int32_t last = std::min(end, p + Terms::kMost);
    terms.work_out(cloud, p, last, plane, total.plane_distance_m);
    for (std::size_t i = 0; i < static_cast<std::size_t>(last - p); ++i) {
      x += static_cast<double>(terms.x[i]);
      y += static_cast<double>(terms.y[i]);
      z += static_cast<double>(terms.z[i]);
      squared_distance += static_cast<double>(terms.squared_distance[i]);
      cubed_depth += static_cast<double>(terms.cubed_depth[i]);
    }
  }
  total.position += Eigen::Vector3d(x, y, z);
  total.squared_distance += squared_distance;
  // A pixel covers depth squared over the cosine.
  total.area_m2 += cubed_depth * static_cast<double>(pixel_area / total.plane_distance_m);
  total.points += end - begin;
}

}  // namespace

void make_surfels(const RoiCloud& cloud, int section, std::span<const SectionPlane> planes,
                  std::span<const std::int16_t> label, const SensorView& view, const RobotSettings& robot,
                  std::vector<PlaneSums>& sums, std::vector<Surfel>& surfels) {
  sums.assign(planes.size(), {});
  for (std::size_t k = 0; k < planes.size(); ++k) sums[k].plane_distance_m = planes[k].plane.distance_m();
  const float pixel_area = 1.0F / (view.camera.fx * view.camera.fy);
  const std::int32_t end = cloud.section_end[static_cast<std::size_t>(section)];
  for (std::int32_t p = cloud.section_begin(section); p < end;) {
    const std::int16_t plane = label[static_cast<std::size_t>(p)];
    std::int32_t run_end = p + 1;
    while (run_end < end && label[static_cast<std::size_t>(run_end)] == plane) ++run_end;
    if (plane >= 0) {
      const auto k = static_cast<std::size_t>(plane);
      add_run(cloud, p, run_end, planes[k].plane, pixel_area, sums[k]);
    }
    p = run_end;
  }
  surfels.clear();
  for (std::size_t k = 0; k < planes.size(); ++k)
    surfels.push_back(surfel_of(planes[k], sums[k], section, view, robot));
}

}  // namespace floornav
