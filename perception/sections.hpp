#pragma once

#include <cmath>

#include "perception/settings.hpp"

namespace floornav {

/// The ROI split into x_res by y_res cuboids of the body frame (section 4.3). Section index = ix * y_res +
/// iy, so that ascending indices run from the nearest row to the farthest.
///
/// Along x all sections are equally long, or, after eq. (5), the sensor's error grows equally much within
/// each: it grows with the square of the distance, so far sections are shorter.
class SectionGrid {
 public:
  /// One side of the ROI: the section is the whole part of (f(coordinate) - min) per_unit, where f(c) is c
  /// or, squared, c |c|.
  struct Axis {
    bool squared;
    float min;
    float per_unit;
    int count;

    /// As a fraction of sections from the ROI's begin.
    [[nodiscard]] float place_of(float coordinate_m) const {
      const float grown = squared ? coordinate_m * std::abs(coordinate_m) : coordinate_m;
      return (grown - min) * per_unit;
    }
    /// The coordinate at which section `k` begins.
    [[nodiscard]] float border_m(int k) const {
      const float grown = min + static_cast<float>(k) / per_unit;
      return squared ? std::copysign(std::sqrt(std::abs(grown)), grown) : grown;
    }
  };

  SectionGrid(const RoiSettings& roi, const SectionSettings& settings)
      : x_(axis(roi.x_min_m, roi.x_max_m, settings.x_res, settings.layout == "error_growth")),
        y_(axis(roi.y_min_m, roi.y_max_m, settings.y_res, false)) {}

  [[nodiscard]] int x_res() const { return x_.count; }
  [[nodiscard]] int y_res() const { return y_.count; }
  [[nodiscard]] int count() const { return x_.count * y_.count; }
  [[nodiscard]] const Axis& x_axis() const { return x_; }
  [[nodiscard]] const Axis& y_axis() const { return y_; }
  /// 0: the nearest.
  [[nodiscard]] int row_of(int section) const { return section / y_.count; }

  /// Section of a point in the body frame, -1 outside the ROI's footprint.
  [[nodiscard]] int at(float x_m, float y_m) const {
    const float fx = x_.place_of(x_m), fy = y_.place_of(y_m);
    if (!(fx >= 0.0F && fy >= 0.0F && fx < static_cast<float>(x_.count) && fy < static_cast<float>(y_.count)))
      return -1;
    return static_cast<int>(fx) * y_.count + static_cast<int>(fy);
  }

 private:
  static Axis axis(double min_m, double max_m, int count, bool squared) {
    const auto grown = [squared](double c) { return squared ? c * std::abs(c) : c; };
    return {squared, static_cast<float>(grown(min_m)),
            static_cast<float>(count / (grown(max_m) - grown(min_m))), count};
  }

  Axis x_;
  Axis y_;
};

}  // namespace floornav
