#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"
#include "runtime/geometry/lattice.hpp"

namespace floornav {

/// The rectangle of lattice cells that holds the ROI as the body stands: dense numbers for its cells.
class CellWindow {
 public:
  CellWindow() = default;
  CellWindow(const Lattice& lattice, const RoiSettings& roi, const Pose& T_world_body) : lattice_(lattice) {
    CellIndex low{INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN};
    for (const double x : {roi.x_min_m, roi.x_max_m})
      for (const double y : {roi.y_min_m, roi.y_max_m})
        for (const double z : {roi.z_min_m, roi.z_max_m}) {
          const Eigen::Vector3d corner = T_world_body * Eigen::Vector3d(x, y, z);
          const CellIndex cell = lattice.cell_of(corner.x(), corner.y());
          low = {std::min(low.ix, cell.ix), std::min(low.iy, cell.iy)};
          high = {std::max(high.ix, cell.ix), std::max(high.iy, cell.iy)};
        }
    origin_ = low;
    size_x_ = high.ix - low.ix + 1;
    size_y_ = high.iy - low.iy + 1;
    per_m_ = 1.0 / lattice.pitch_m;
  }

  [[nodiscard]] std::int32_t count() const { return size_x_ * size_y_; }
  [[nodiscard]] std::int32_t size_x() const { return size_x_; }
  [[nodiscard]] std::int32_t size_y() const { return size_y_; }
  [[nodiscard]] const Lattice& lattice() const { return lattice_; }

  /// Number of the cell at a place of the local world frame, -1 outside the window.
  [[nodiscard]] std::int32_t at(double x_m, double y_m) const {
    return at_pitches(x_m * per_m_ - origin_.ix, y_m * per_m_ - origin_.iy);
  }
  /// The same for a place counted in pitches from the window's corner.
  template <class Number>
  [[nodiscard]] std::int32_t at_pitches(Number x, Number y) const {
    if (!(x >= 0 && y >= 0 && x < static_cast<Number>(size_x_) && y < static_cast<Number>(size_y_)))
      return -1;
    return static_cast<std::int32_t>(y) * size_x_ + static_cast<std::int32_t>(x);
  }
  [[nodiscard]] Eigen::Vector2d pitches_of(const Eigen::Vector3d& p) const {
    return {p.x() * per_m_ - origin_.ix, p.y() * per_m_ - origin_.iy};
  }
  [[nodiscard]] CellIndex cell(std::int32_t number) const {
    return {origin_.ix + number % size_x_, origin_.iy + number / size_x_};
  }

 private:
  Lattice lattice_;
  CellIndex origin_;
  std::int32_t size_x_ = 0;
  std::int32_t size_y_ = 0;
  double per_m_ = 1.0;  ///< cells a metre
};

}  // namespace floornav
