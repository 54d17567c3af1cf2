#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "perception/compromise.hpp"
#include "runtime/geometry/lattice.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// A patch of a plane, as a disc (section 3.1). Local world frame.
struct Surfel {
  Eigen::Vector3d centroid_m;
  Eigen::Vector3f normal;    ///< unit, towards the sensor
  float radius_m = 0;        ///< from the area that its points span
  float rms_m = 0;           ///< distance of its points from the plane
  std::int32_t points = 0;   ///< inliers
  std::int16_t section = 0;  ///< index into FloorEvidence::sections
  bool dominant = false;     ///< the section's floor plane: first pass of the recursion
  bool traversable = false;  ///< within the robot's slope and height limits
};

/// What one lattice cell saw in one frame. Heights: z in the local world frame, m.
struct CellEvidence {
  CellIndex cell;
  std::int16_t surfel = -1;  ///< index into FloorEvidence::surfels; -1: none of its points is on a surfel
  std::int32_t points = 0;   ///< 0: only sight lines
  /// Of what decides the cell: of a plane flatter than 30 degrees the height in the cell's middle, of others
  /// the mean of its points.
  float mean_z_m = std::numeric_limits<float>::quiet_NaN();
  float var_z_m2 = std::numeric_limits<float>::quiet_NaN();  ///< variance of mean_z_m by eq. (3) / (4)
  float top_z_m = std::numeric_limits<float>::quiet_NaN();   ///< robust highest place that was seen
  float ray_z_m = std::numeric_limits<float>::quiet_NaN();   ///< lowest height at which a ray passed through
  bool no_return = false;      ///< rays should have ended on a floor here and brought nothing back
  bool partly_hidden = false;  ///< the outline of something nearer goes through the cell
  bool on_edge = false;        ///< the cell is level ground, but the border of that or a side goes through it
};

struct SectionReport {
  std::int16_t ix = 0;   ///< along x, 0 nearest to the robot
  std::int16_t iy = 0;   ///< along y, 0 at the right
  bool done = false;     ///< false: skipped, carries no evidence
  std::int16_t age = 0;  ///< frames since it was last done
  std::int32_t points = 0;
  bool later = false;  ///< not known yet: a later part of the frame tells
};

/// What became of a frame's pixels.
struct PixelCounts {
  std::int64_t no_measurement = 0;  ///< nothing came back, or an absurd value
  std::int64_t too_near = 0;
  std::int64_t too_uncertain = 0;  ///< beyond the noise bound of eq. (3) / (4)
  std::int64_t outside_roi = 0;
  std::int64_t in_roi = 0;
  std::int64_t outliers = 0;  ///< of in_roi: removed by eq. (6)
};

/// All that perception tells of one frame.
struct FloorEvidence {
  std::int64_t utime_us = 0;
  Pose T_world_body = Pose::Identity();
  Pose T_body_sensor = Pose::Identity();
  Lattice lattice;
  PixelCounts pixels;
  Compromise compromise;  ///< what the frame gave up
  std::vector<SectionReport> sections;
  std::vector<Surfel> surfels;
  std::vector<CellEvidence> cells;
};

}  // namespace floornav
