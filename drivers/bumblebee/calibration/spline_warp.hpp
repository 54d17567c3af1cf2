#pragma once

#include <array>
#include <vector>

#include <opencv2/core.hpp>

namespace floornav {

/// Where a place between 0 and 1 lies among a uniform cubic B-spline's coefficients.
struct SplinePlace {
  int first = 0;                 ///< of the four coefficients that count
  std::array<double, 4> weight;  ///< of each
};
/// `count` coefficients, at least 4. Outside of 0 .. 1 the border's polynomial goes on.
SplinePlace spline_place(double t, int count);

/// A smooth map of the unit square: two tensor products of uniform cubic B-splines.
struct SplineWarp {
  int columns = 0;                 ///< of coefficients, over x; at least 4
  int rows = 0;                    ///< over y; at least 4
  std::vector<double> to_x, to_y;  ///< of column i and row j at i * rows + j

  [[nodiscard]] cv::Point2d at(double x, double y) const;
};

}  // namespace floornav
