#pragma once

#include <cstdint>
#include <vector>

#include "perception/cell_window.hpp"
#include "perception/measured_image.hpp"
#include "perception/sensor_view.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// What the outlines of a frame tell of each cell of the window.
struct Outlines {
  /// The outline of something nearer goes through the cell: a part of it is hidden.
  std::vector<std::uint8_t> hidden;
  /// z of the lowest ledge in the cell, m in the local world frame: a place behind which the sight falls by
  /// more than the least drop. +inf: none.
  std::vector<float> ledge_z_m;
};

/// Finds the outlines of things, as the sensor sees them, and the cells through which they go: behind them
/// those of which something nearer hides a part, so that what was seen tells nothing of the rest; before them
/// those in which a surface ends.
///
/// An outline lies between two neighbouring pixels of which one is clearly nearer than a floor through the
/// other would be there; pixels that measured nothing (the shadow of the projector) may lie between them.
/// It goes on in the next row or column, as noise does not. The rays just past it end in the hidden cells,
/// those just before it in the cells with a ledge.
class OutlineFinder {
 public:
  explicit OutlineFinder(double least_drop_m) : least_drop_m_(static_cast<float>(least_drop_m)) {}

  void find(const MeasuredImage& image, const SensorView& view, const CellWindow& window, Parallel& parallel,
            Outlines& outlines);

 private:
  /// What one worker sees.
  struct Worker {
    Outlines found;
    std::vector<std::int32_t> outline_row;  ///< a column: the last row in which an outline went beside it
    std::vector<std::int32_t> steps;        ///< columns of a row where outlines may be
  };
  struct Sight;
  static void look_at_rows(const Sight& sight, int first_row, int end_row, Worker& worker);
  static void look_at_row(const Sight& sight, int row, Worker& worker);

  float least_drop_m_;
  std::vector<Worker> workers_;
};

}  // namespace floornav
