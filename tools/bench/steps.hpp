#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mapping/grid_map.hpp"
#include "runtime/geometry/parallel.hpp"
#include "tools/bench/step_course.hpp"
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

/// Whether the map shows the step: at half or more of the places along it, an edge between the two sides is
/// closed, or their heights differ by the rise within half of it. Behind an edge that falls the first floor
/// that can be seen is looked at.
bool shows_step(const GridMap& map, const StepEdge& edge);

/// Places on a plain floor, 0.2 m apart, and how many of them look like a step of 1 cm: a closed edge to a
/// place 0.2 m away, or a difference from the true heights of half a centimetre or more.
struct PlainCheck {
  int places = 0;
  int alarms = 0;
};
PlainCheck check_plain(const GridMap& map, const Ground& ground);

struct StepOptions {
  std::vector<SensorKind> sensors{SensorKind::kKinect, SensorKind::kBumblebee};
  int poses = 20;          ///< random ones a height
  double plain_m2 = 1000;  ///< of floor seen, for the false alarms
  std::uint64_t seed = 1;
};

/// Steps of 1, 2, 3 and 5 cm at every distance, both noises, one frame and ten; false alarms on plain floor.
std::vector<StepRow> measure_steps(const StepOptions& options, Parallel& parallel,
                                   const std::function<void(const std::string&)>& progress);

}  // namespace floornav
