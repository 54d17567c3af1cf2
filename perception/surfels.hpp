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

/// Makes surfels of a section's planes (section 3.1): one a plane, in the planes' order, in the local world
/// frame. Points are moved along their rays onto the plane; the radius is that of a disc of the area that
/// they cover.
std::vector<Surfel> make_surfels(const RoiCloud& cloud, int section, std::span<const SectionPlane> planes,
                                 std::span<const std::int16_t> label, const SensorView& view,
                                 const RobotSettings& robot);

}  // namespace floornav
