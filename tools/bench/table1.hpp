#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mapping/grid_map.hpp"
#include "perception/settings.hpp"
#include "runtime/geometry/parallel.hpp"
#include "tools/bench/obstacle_course.hpp"

namespace floornav {

/// Errors of obstacles' heights in one class.
struct HeightErrors {
  int count = 0;
  int missed = 0;  ///< reported with less than half of their height: each counts with its full height
  double sum_m = 0;
  double worst_m = 0;

  void add(double found_m, double true_m);
  void add(const HeightErrors& more);
  [[nodiscard]] double mean_cm() const { return count > 0 ? 100.0 * sum_m / count : 0.0; }
};

/// Of obstacles with level and with sloped tops.
struct TopErrors {
  HeightErrors flat;
  HeightErrors sloped;

  void add(const TopErrors& more);
  [[nodiscard]] HeightErrors all() const;
};

/// One row of Table 1 as measured here.
struct Table1Row {
  SensorKind sensor = SensorKind::kKinect;
  int x_res = 4;
  int y_res = 3;
  bool correlated = false;
  bool error_growth = false;  ///< sections after eq. (5) instead of equally long ones
  bool matched = false;       ///< rendered pairs of images, matched; the noise is theirs
  TopErrors near;             ///< < 3 m
  TopErrors far;              ///< 3..5.5 m
  double floor_square_m2 = 0;
  int floor_vertices = 0;  ///< up to 6 m from the robot

  /// Adds what was measured on another configuration of the same row.
  void add(const Table1Row& more);
};

/// The paper's area in front of the robot for a sensor.
CoveredArea covered_area(SensorKind sensor);

/// Perception's settings for a row: the paper's area, split into x_res x y_res sections.
PerceptionSettings perception_for(SensorKind sensor, const SectionSettings& sections);

/// A sensor at full resolution; correlated: noise as block matching makes it.
SensorSpec bench_sensor(SensorKind sensor, bool correlated);

/// Adds what a map, published after frames of a course, says of its obstacles and its floor.
void judge(const ObstacleCourse& course, const GridMap& map, Table1Row& row);

/// What the paper gives for a sensor and a grid of equally long sections, cm.
struct PaperRow {
  double near_cm = 0;
  double far_cm = 0;
};
PaperRow paper_row(SensorKind sensor, int x_res, int y_res);

struct Table1Options {
  std::vector<SensorKind> sensors{SensorKind::kKinect, SensorKind::kBumblebee};
  int configurations = 20;
  std::uint64_t seed = 1;
  bool matched = false;  ///< the Bumblebee's rows from matched pairs of images, too
};

/// Table 1 of the paper: obstacle courses for each sensor, noise and section grid, one frame each; the
/// highest published grid_map_t vertex (0.1 m) within a footprint and one cell around, against the truth.
/// `progress` is called with a line for a person now and then.
std::vector<Table1Row> measure_table1(const Table1Options& options, Parallel& parallel,
                                      const std::function<void(const std::string&)>& progress);

}  // namespace floornav
