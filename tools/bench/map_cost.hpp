#pragma once

#include <cstdint>
#include <vector>

#include "perception/evidence.hpp"

namespace floornav {

/// What the surfels of VGA frames cost the mapper, in processor time of one core.
struct FuseCost {
  double cells = 0;           ///< of a frame, mean
  double fuse_median_ms = 0;  ///< alignment and fusion
  double fuse_p99_ms = 0;
  double refresh_median_ms = 0;  ///< judging what changed: states, edges
  double refresh_p99_ms = 0;
  double terrain_bytes_per_m2 = 0;       ///< of TERRAIN_MAP at 0.2 m
  double fine_terrain_bytes_per_m2 = 0;  ///< at 0.1 m
};

/// Updates of a robot that drives to and fro in one street of a map of some size.
struct MapSizeCost {
  double area_m2 = 0;  ///< seen
  double update_median_ms = 0;
  double update_mean_ms = 0;
  double bytes_per_m2 = 0;  ///< of the mapper's whole state
};

/// The evidence of a Kinect at 640 x 480 on a drive of 0.1 m a frame along a street with boxes, true poses.
std::vector<FloorEvidence> kinect_evidence(int frames);

FuseCost measure_fuse(const std::vector<FloorEvidence>& frames, int repeats);

/// The same drive on maps of these areas, m2, in rising order: the rest of the map is floor seen before.
std::vector<MapSizeCost> measure_map_sizes(const std::vector<FloorEvidence>& frames,
                                           const std::vector<double>& areas_m2);

}  // namespace floornav
