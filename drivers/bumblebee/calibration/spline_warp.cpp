#include "drivers/bumblebee/calibration/spline_warp.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

SplinePlace spline_place(double t, int count) {
  const int spans = count - 3;
  const double at = t * spans;
  const int first = std::clamp(static_cast<int>(std::floor(at)), 0, spans - 1);
  const double u = at - first;
  const double v = 1 - u;
  return {first,
          {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6,
           u * u * u / 6}};
}

cv::Point2d SplineWarp::at(double x, double y) const {
  const SplinePlace across = spline_place(x, columns);
  const SplinePlace down = spline_place(y, rows);
  cv::Point2d sum(0, 0);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const auto k = static_cast<std::size_t>((across.first + i) * rows + down.first + j);
      const double weight =
          across.weight[static_cast<std::size_t>(i)] * down.weight[static_cast<std::size_t>(j)];
      sum += weight * cv::Point2d(to_x[k], to_y[k]);
    }
  return sum;
}

}  // namespace floornav
