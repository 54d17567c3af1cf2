#pragma once

#include "mapping/cell_memory.hpp"
#include "mapping/frame_alignment.hpp"
#include "runtime/geometry/settings.hpp"

namespace floornav {

/// How the mapper remembers and judges.
struct MappingSettings {
  double resolution_m = 0.05;         ///< side of a vertex; an integer multiple of perception's lattice pitch
  double terrain_resolution_m = 0.2;  ///< side of a terrain cell; an integer multiple of the pitch
  double min_belief = 0;  ///< a vertex with less is blocked (section 4.6), 0..1; 0: as the robot's limits ask
  double view_sigma_m = 0.003;  ///< pose jitter and calibration: added to the sensor's own noise of each view
  double memory_sigma_m = 0.001;    ///< a fused height never claims to be better, so that it can still follow
  double overhead_margin_m = 0.05;  ///< what hangs higher than the robot plus this does not block
  double max_range_m = 8.0;         ///< evidence farther from the robot is refused
  int no_return_frames = 3;         ///< frames of rays that found no floor, before its edge counts as a drop
  AlignmentSettings alignment;      ///< of a frame with the map
};

template <class Visitor>
void visit_settings(Visitor& visit, MappingSettings& s) {
  visit("resolution_m", s.resolution_m, Allowed{0.01, 1.0});
  visit("terrain_resolution_m", s.terrain_resolution_m, Allowed{0.01, 2.0});
  visit("min_belief", s.min_belief, Allowed{0.0, 1.0});
  visit("view_sigma_m", s.view_sigma_m, Allowed{0.0001, 0.1});
  visit("memory_sigma_m", s.memory_sigma_m, Allowed{0.0001, 0.1});
  visit("overhead_margin_m", s.overhead_margin_m, Allowed{0.0, 1.0});
  visit("max_range_m", s.max_range_m, Allowed{0.5, 20.0});
  visit("no_return_frames", s.no_return_frames, Allowed{1, CellMemory::kMostFloorDoubt});
  visit("alignment", s.alignment);
}

}  // namespace floornav
