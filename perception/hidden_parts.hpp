#pragma once

#include <cstdint>
#include <vector>

#include "perception/cell_window.hpp"
#include "perception/measured_image.hpp"
#include "perception/sensor_view.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Finds the cells through which the outline of something nearer goes, as the sensor sees it: a part of each
/// is hidden, and what was seen of it tells nothing of the rest.
///
/// The outline lies between two neighbouring pixels of which one is clearly nearer than a floor through the
/// other would be there; pixels that measured nothing (the shadow of the projector) may lie between them.
/// It goes on in the next row or column, as noise does not. It goes through the cells in which the rays just
/// past it end.
class HiddenPartFinder {
 public:
  /// Writes to `hidden` for each cell of the window whether a part of it is hidden.
  void find(const MeasuredImage& image, const SensorView& view, const CellWindow& window, Parallel& parallel,
            std::vector<std::uint8_t>& hidden);

 private:
  /// What one worker sees.
  struct Worker {
    std::vector<std::uint8_t> passed;       ///< a cell: a ray past an outline ends in it
    std::vector<std::int32_t> outline_row;  ///< a column: the last row in which an outline went beside it
    std::vector<std::int32_t> steps;        ///< columns of a row where outlines may be
  };
  struct Sight;
  static void look_at_rows(const Sight& sight, int first_row, int end_row, Worker& worker);
  static void look_at_row(const Sight& sight, int row, Worker& worker);

  std::vector<Worker> workers_;
};

}  // namespace floornav
