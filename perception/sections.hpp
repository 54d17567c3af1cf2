#pragma once

#include <cmath>

#include "perception/settings.hpp"

namespace floornav {

/// The ROI split into x_res by y_res cuboids of the body frame (section 4.3). Section index = ix * y_res +
/// iy, so that ascending indices run from the nearest row to the farthest: the order of their priority.
class SectionGrid {
 public:
  SectionGrid(const RoiSettings& roi, const SectionSettings& settings)
      : x_res_(settings.x_res),
        y_res_(settings.y_res),
        x_min_m_(static_cast<float>(roi.x_min_m)),
        y_min_m_(static_cast<float>(roi.y_min_m)),
        per_x_m_(static_cast<float>(settings.x_res / (roi.x_max_m - roi.x_min_m))),
        per_y_m_(static_cast<float>(settings.y_res / (roi.y_max_m - roi.y_min_m))) {}

  [[nodiscard]] int x_res() const { return x_res_; }
  [[nodiscard]] int y_res() const { return y_res_; }
  [[nodiscard]] int count() const { return x_res_ * y_res_; }

  /// Section of a point in the body frame, -1 outside the ROI's footprint.
  [[nodiscard]] int at(float x_m, float y_m) const {
    const float fx = (x_m - x_min_m_) * per_x_m_;
    const float fy = (y_m - y_min_m_) * per_y_m_;
    if (!(fx >= 0.0F && fy >= 0.0F && fx < static_cast<float>(x_res_) && fy < static_cast<float>(y_res_)))
      return -1;
    return static_cast<int>(fx) * y_res_ + static_cast<int>(fy);
  }

 private:
  int x_res_;
  int y_res_;
  float x_min_m_;
  float y_min_m_;
  float per_x_m_;
  float per_y_m_;
};

}  // namespace floornav
