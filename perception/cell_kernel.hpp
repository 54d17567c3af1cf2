#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/cell_window.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_planes.hpp"
#include "perception/sensor_view.hpp"

namespace floornav {

/// The frame's planes as the cells need them, as structure of arrays.
struct PlanesInWorld {
  std::vector<float> a, b, c;                       ///< of InverseDepthPlane
  std::vector<float> normal_x, normal_y, normal_z;  ///< sensor frame
  std::vector<float> upright;                       ///< z of the normal in the world frame

  void clear();
  void add(const InverseDepthPlane& plane, const Eigen::Matrix3f& R_world_sensor);
  [[nodiscard]] std::size_t size() const { return a.size(); }
};

/// Where the frame's points lie on the map, as structure of arrays. Heights: z in the local world frame, m.
struct PlacedPoints {
  std::vector<std::int32_t> cell;  ///< of the window; -1: none
  std::vector<float> z_m;  ///< of the point moved along its ray onto its plane; as measured where it has none
  std::vector<float>
      rise_m;  ///< vertical distance of the measured surface above the plane; 0 without a plane
  std::vector<float> var_m2;     ///< of rise_m, or of z_m without a plane, by eq. (3) / (4)
  std::vector<float> common_m2;  ///< variance that the cell's points have in common: their mean keeps it

  void resize(std::size_t points);
};

/// Places the points [begin, end) of one section, of which the first plane is number `first_plane`.
void place_points(const RoiCloud& cloud, std::span<const std::int16_t> label, std::int32_t begin,
                  std::int32_t end, const PlanesInWorld& planes, std::int32_t first_plane, float roughness_m,
                  const SensorView& view, const CellWindow& window, PlacedPoints& out);

}  // namespace floornav
