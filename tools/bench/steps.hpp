#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/geometry/parallel.hpp"
#include "tools/simulator/sensor_spec.hpp"

namespace floornav {

/// How often steps of one height at one distance were found.
struct StepRow {
  SensorKind sensor = SensorKind::kKinect;
  bool correlated = false;
  double height_m = 0;
  double distance_m = 0;
  int frames = 1;  ///< 1, or 10 of a robot that drives at 0.2 m/s
  int poses = 0;
  int found = 0;
  double false_per_m2 = 0;  ///< with the same settings, on floor without steps
};

struct StepOptions {
  std::vector<SensorKind> sensors{SensorKind::kKinect, SensorKind::kBumblebee};
  int poses = 20;          ///< random ones a height
  double plain_m2 = 1000;  ///< of floor seen in one frame each, for the false alarms
  std::uint64_t seed = 1;
};

/// Steps of 1, 2, 3 and 5 cm at every distance, both noises, one frame and ten; false alarms on plain floor,
/// with the same settings. One drive up to a course serves all that is asked of it: its image shows an edge
/// at every distance; its last frame, seen by a stack that knows nothing yet, is the single frame; the two
/// noises disturb the same exact depths. Drives are independent and run in parallel. `tell_done` is called
/// with how many drives of how many have ended.
std::vector<StepRow> measure_steps(const StepOptions& options, Parallel& parallel,
                                   const std::function<void(int done, int drives)>& tell_done);

}  // namespace floornav
