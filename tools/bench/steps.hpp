#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mapping/grid_map.hpp"
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
/// closed, or their heights differ by the rise within half of it.
bool shows_step(const GridMap& map, const StepEdge& edge);

/// Places on a plain floor, 0.2 m apart, and how many of them look like a step of 1 cm: a closed edge to a
/// place 0.2 m away, or a difference from the true heights of half a centimetre or more.
struct PlainCheck {
  int places = 0;
  int alarms = 0;
};
PlainCheck check_plain(const GridMap& map, const Ground& ground);

/// Steps of 1, 2, 3 and 5 cm at every distance, `poses` random poses each, both sensors and both noises, one
/// frame and ten; false alarms over `plain_m2` of floor.
std::vector<StepRow> measure_steps(int poses, double plain_m2, std::uint64_t seed,
                                   const std::function<void(const std::string&)>& progress);

}  // namespace floornav
