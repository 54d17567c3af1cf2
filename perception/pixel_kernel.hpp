#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "perception/depth_frame.hpp"
#include "perception/measured_image.hpp"
#include "perception/sections.hpp"

namespace floornav {

/// What turns a frame's counts into inverse depths, by eq. (3) / (4); for depth pixels the rounding to whole
/// counts adds its share to the noise.
struct MeasurementModel {
  /// `roughness_m`: 1 sigma that surfaces and calibration add to the depth.
  MeasurementModel(const DepthFrame& frame, float roughness_m);

  bool is_depth;
  float scale;              ///< m or px a count
  float per_disparity;      ///< 1/m of inverse depth a px of disparity
  float sigma_px;           ///< of disparity, where no uncertainty plane says otherwise
  float uncertainty_scale;  ///< px a count of the uncertainty plane
  float added_m2;           ///< variance of depth besides that of the disparity
};

/// Measures a row of the frame. The same bits whatever the instruction set.
void measure_row(const DepthFrame& frame, const MeasurementModel& model, int row, MeasuredImage& image);

/// Where a row's points must lie to count (sections 3.4 and 4.2), and where its rays go.
struct RowRegion {
  const float* ray_x;         ///< a column, padded as the image
  Eigen::Vector3f per_ray_x;  ///< body frame: the ray at depth 1 is per_ray_x ray_x + of_row
  Eigen::Vector3f of_row;
  Eigen::Vector3f origin;   ///< of the sensor, body frame
  float max_inverse_depth;  ///< 1/m
  float max_sigma_z;        ///< m
  float z_min, z_max;       ///< m, body frame
};

/// How many pixels of a row had which fate; those without measurement include the padding.
struct RowCounts {
  std::int64_t no_measurement = 0, too_near = 0, too_uncertain = 0, outside_roi = 0;
};

/// Writes the section of each pixel of a row to `section` (as long as the image's rows), -1 where its point
/// does not count.
RowCounts find_sections(const MeasuredImage& image, int row, const RowRegion& region, const SectionGrid& grid,
                        std::int16_t* section);

}  // namespace floornav
