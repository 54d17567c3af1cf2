#pragma once

#include <optional>

#include "perception/evidence.hpp"
#include "perception/sensor_view.hpp"

namespace floornav {

/// The greatest height within a cell of the line where a side meets a flatter surfel: the edge of a box
/// between its side and its top. Where the line passes the cell by, the height at the place of the cell that
/// is next to it; nothing where it is more than a cell away, or the two are parallel. `middle` and `pitch_m`
/// are the cell's, local world frame.
std::optional<float> edge_z_m(const Surfel& side, const Surfel& top, const Eigen::Vector2d& middle,
                              double pitch_m);

/// Where a side ends at a flatter obstacle surfel. Points of the top just behind the edge fit the side within
/// its noise, and lie too high when they are taken for points of it: where the side meets a flatter obstacle
/// surfel near by, no farther below `top_z_m` than noise throws a point, it ends there. `thrown_m`: how far
/// noise throws a point from the side, up or down. Nothing where it meets none.
std::optional<float> edge_with_top_z_m(float top_z_m, float thrown_m, const CellEvidence& cell,
                                       const SensorView& view, const FloorEvidence& evidence);

}  // namespace floornav
