#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/evidence.hpp"
#include "perception/reach.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_planes.hpp"
#include "perception/sensor_view.hpp"

namespace floornav {

/// Sums over the points of one plane.
struct PlaneSums {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< sensor frame
  double squared_distance = 0.0;
  double area_m2 = 0.0;
  std::int32_t points = 0;
  float plane_distance_m = 0.0F;  ///< of the plane from the sensor
};

/// Makes surfels of a section's planes (section 3.1): one a plane, in the planes' order, in the local world
/// frame. Points are moved along their rays onto the plane; the radius is that of a disc of the area that
/// they cover. `sums` is scratch memory.
void make_surfels(const RoiCloud& cloud, int section, std::span<const SectionPlane> planes,
                  std::span<const std::int16_t> label, const SensorView& view, const RobotSettings& robot,
                  std::vector<PlaneSums>& sums, std::vector<Surfel>& surfels);

}  // namespace floornav
