#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "perception/cell_window.hpp"
#include "perception/measured_image.hpp"
#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"
#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// Finds the lowest height at which a ray passed over each cell on its way to something beyond.
///
/// All rays leave from one point, so of two in one direction of the compass the one that falls more steeply
/// is the lower one all along. So each ray only tells how steep it was to the bin, by direction and distance,
/// in which it ends; the steepest of those that end beyond a place is the lowest over it.
class SightLineTracer {
 public:
  SightLineTracer(const RoiSettings& roi, const CellSettings& cells);

  /// Writes the lowest height, m in the local world frame, of each cell of the window; +inf: no ray passed.
  void trace(const MeasuredImage& image, const SensorView& view, const CellWindow& window, Parallel& parallel,
             std::vector<float>& lowest_z_m);

 private:
  static constexpr float kNone = std::numeric_limits<float>::infinity();

  /// The steepest slope (vertical metres a horizontal one) of the rays that end in each bin.
  struct Fan {
    std::vector<float> slope;          ///< direction by direction, from near to far
    std::vector<std::uint8_t> is_hit;  ///< a direction: some ray went there
  };
  void follow_row(const MeasuredImage& image, const SensorView& view, int row, Fan& fan) const;
  void lower_cells(std::size_t direction, const SensorView& view, const CellWindow& window,
                   std::vector<float>& lowest_z_m);

  RoiSettings roi_;
  double pitch_m_;
  int stride_px_;
  float step_m_;            ///< between bins of distance
  std::size_t directions_;  ///< bins around the compass
  std::size_t distances_;
  std::vector<Fan> fans_;  ///< a worker
};

}  // namespace floornav
