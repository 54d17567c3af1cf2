#pragma once

#include <cstdint>
#include <vector>

#include "perception/cell_window.hpp"

namespace floornav {

/// How far the surface that a cell's points measure lies above the plane that decides the cell: sums over its
/// points on that plane.
struct CellRise {
  static constexpr std::int16_t kNone = -1;
  static constexpr std::int16_t kFloor = INT16_MAX;  ///< group of all sections' floors

  std::int16_t group = kNone;  ///< cells of one group lie on one plane; kNone: no plane decides
  std::int32_t points = 0;
  float rise_m = 0.0F;     ///< sum
  float var_m2 = 0.0F;     ///< sum: what each point's noise adds
  float common_m2 = 0.0F;  ///< sum: what the points of a cell have in common

  CellRise& operator+=(const CellRise& more) {
    points += more.points;
    rise_m += more.rise_m;
    var_m2 += more.var_m2;
    common_m2 += more.common_m2;
    return *this;
  }
  [[nodiscard]] float mean_m() const { return rise_m / static_cast<float>(points); }
  /// Variance of the mean, if the points are so many independent measurements.
  [[nodiscard]] float variance_m2(float measurements) const {
    return (var_m2 / measurements + common_m2) / static_cast<float>(points);
  }
};

/// How a frame's noise looks at a cell: how wide it is in the image, and over how many pixels noise is alike.
struct CellNoise {
  float width_px = 1.0F;
  float alike_px = 1.0F;
};

/// The part of a cell's rise that is no accident of the noise, from coarse to fine: the mean over the 5 x 5
/// cells around it, what the 3 x 3 around it differ from that, and what it differs from those itself; each
/// drawn towards zero as far as it is not significant: d max(0, 1 - s^2 var / d^2) with s =
/// `significance_sigmas`. So flat floor stays flat, a wide step shows though no single cell could tell it,
/// and a narrow one stays narrow. Neighbours of another group do not count. `rises` are the window's cells.
float significant_rise(const std::vector<CellRise>& rises, const CellWindow& window, std::int32_t number,
                       float significance_sigmas, const CellNoise& noise);

}  // namespace floornav
