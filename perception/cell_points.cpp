#include "perception/cell_points.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

namespace {

/// Steeper planes have no height of their own at a place: their points count as they lie on the plane.
constexpr float kMinUpright = 0.5F;
/// A ray this close to the plane's own direction says nothing about where it meets it.
constexpr float kMinFacing = 0.02F;

/// A plane as the cells need it.
struct PlaneInWorld {
  InverseDepthPlane plane;
  Eigen::Vector3f normal;  ///< sensor frame
  float upright;           ///< z of the normal in the world frame
  std::int16_t surfel;
};

}  // namespace

void CellSorter::sort(const RoiCloud& cloud, std::span<const std::int16_t> label,
                      std::span<const SectionResult> sections, const SensorView& view,
                      const CellWindow& window, Parallel& parallel, CellPoints& out) {
  cell_.assign(cloud.size(), -1);
  placed_.resize(cloud.size());
  parallel.run(static_cast<int>(sections.size()), [&](int section, int) {
    const SectionResult& result = sections[static_cast<std::size_t>(section)];
    if (result.done) place_section(cloud, label, section, result, view, window);
  });

  out.cell_end.assign(static_cast<std::size_t>(window.count()) + 1, 0);
  for (const std::int32_t cell : cell_)
    if (cell >= 0) ++out.cell_end[static_cast<std::size_t>(cell) + 1];
  for (std::size_t c = 1; c < out.cell_end.size(); ++c) out.cell_end[c] += out.cell_end[c - 1];
  out.points.resize(static_cast<std::size_t>(out.cell_end.back()));
  // cell_end[c] is the begin of cell c until its points are in; then it is its end.
  for (std::size_t i = 0; i < cell_.size(); ++i)
    if (cell_[i] >= 0)
      out.points[static_cast<std::size_t>(out.cell_end[static_cast<std::size_t>(cell_[i])]++)] = placed_[i];
  out.cell_end.pop_back();
}

void CellSorter::place_section(const RoiCloud& cloud, std::span<const std::int16_t> label, int section,
                               const SectionResult& result, const SensorView& view,
                               const CellWindow& window) {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  const Eigen::Vector3d sensor = view.T_world_sensor.translation();
  std::vector<PlaneInWorld> planes;
  for (std::size_t k = 0; k < result.planes.size(); ++k) {
    const Eigen::Vector3f normal = result.planes[k].plane.normal();
    planes.push_back({result.planes[k].plane, normal, (R * normal).z(),
                      static_cast<std::int16_t>(result.first_surfel + static_cast<std::int16_t>(k))});
  }
  for (std::int32_t p = cloud.section_begin(section);
       p < cloud.section_end[static_cast<std::size_t>(section)]; ++p) {
    const auto i = static_cast<std::size_t>(p);
    if (label[i] != kNoPlane && label[i] < 0) continue;
    const Eigen::Vector3f ray(cloud.ray_x[i], cloud.ray_y[i], 1.0F);
    const float sigma_depth = cloud.z[i] * cloud.z[i] / cloud.certainty[i];
    float depth = cloud.z[i];
    CellPoint point{-1, 0.0F, 0.0F, 0.0F, 0.0F};
    float per_depth = (R * ray).z();  // vertical metres a metre of depth
    if (label[i] >= 0) {
      const PlaneInWorld& plane = planes[static_cast<std::size_t>(label[i])];
      const float facing = -plane.normal.dot(ray);
      if (facing > kMinFacing) depth = 1.0F / plane.plane.inverse_depth(ray.x(), ray.y());
      point.surfel = plane.surfel;
      if (plane.upright > kMinUpright) {
        per_depth = facing / plane.upright;
        point.rise_m = (depth - cloud.z[i]) * per_depth;
      }
    }
    point.var_m2 = sigma_depth * sigma_depth * per_depth * per_depth;
    point.common_m2 = roughness_m_ * roughness_m_ * per_depth * per_depth;
    const Eigen::Vector3d world = sensor + (depth * (R * ray)).cast<double>();
    point.z_m = static_cast<float>(world.z());
    cell_[i] = window.at(world.x(), world.y());
    placed_[i] = point;
  }
}

}  // namespace floornav
