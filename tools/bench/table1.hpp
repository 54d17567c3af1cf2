#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/bench/obstacle_course.hpp"

namespace floornav {

/// Errors of obstacles' heights in one class.
struct HeightErrors {
  int count = 0;
  int missed = 0;  ///< reported with less than half of their height: each counts with its full height
  double sum_m = 0;
  double worst_m = 0;

  void add(double found_m, double true_m);
  [[nodiscard]] double mean_cm() const { return count > 0 ? 100.0 * sum_m / count : 0.0; }
};

/// One row of Table 1 as measured here.
struct Table1Row {
  SensorKind sensor = SensorKind::kKinect;
  int x_res = 4;
  int y_res = 3;
  bool correlated = false;
  HeightErrors near;    ///< < 3 m
  HeightErrors far;     ///< 3..5.5 m
  HeightErrors flat;    ///< all distances, level tops
  HeightErrors sloped;  ///< all distances, sloped tops
  double floor_square_m2 = 0;
  int floor_vertices = 0;
};

/// What the paper gives for a sensor and a section grid, cm.
struct PaperRow {
  double near_cm = 0;
  double far_cm = 0;
};
PaperRow paper_row(SensorKind sensor, int x_res, int y_res);

/// Table 1 of the paper: `configurations` obstacle courses for each sensor, noise and section grid, one frame
/// each; the highest published grid_map_t vertex (0.1 m) within a footprint and one cell around, against the
/// truth. `progress` is called with a line for a person now and then.
std::vector<Table1Row> measure_table1(int configurations, std::uint64_t seed,
                                      const std::function<void(const std::string&)>& progress);

}  // namespace floornav
