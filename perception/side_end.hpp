#pragma once

#include <optional>
#include <vector>

#include "perception/evidence.hpp"
#include "perception/measured_image.hpp"
#include "perception/sensor_view.hpp"

namespace floornav {

/// A pixel beside the upper end of a side.
struct EndPixel {
  float inverse_depth;  ///< measured, 1/m
  float certainty;      ///< m: 1 / (1 sigma of inverse_depth)
  float on_side;        ///< inverse depth where its ray meets the side's plane, 1/m
  float down;           ///< how far its ray goes down a metre of depth
};

/// Where a side is thought to end in a cell.
struct SideEnd {
  Eigen::Vector2d middle;  ///< of the cell, local world frame
  double pitch_m;          ///< of the cell
  float top_z_m;           ///< the highest point on the side
  float below_m;           ///< the end is sought from there on down to this far below it
};

/// How high a side reaches in a cell, told by the pixels around its upper end: a ray meets the side, or the
/// level top behind it, whichever is farther off; sought is the height of the top that explains the pixels
/// best. The highest point on the side alone lies too high, since points of the top just behind the edge fit
/// the side within the sensor's noise: by centimetres 4 m away. Nothing where the sensor does not look down
/// on that end, or hardly any pixel shows it. `pixels` is scratch memory.
std::optional<float> side_end_z_m(const Surfel& side, const SideEnd& end, const MeasuredImage& image,
                                  const SensorView& view, std::vector<EndPixel>& pixels);

}  // namespace floornav
