#pragma once

#include <vector>

#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// The part of the body frame that matters, m.
struct MatchedRegion {
  double x_min_m = 0.0;
  double x_max_m = 4.9;
  double y_min_m = -2.0;
  double y_max_m = 2.0;
  double z_min_m = -0.3;
  double z_max_m = 0.75;
};

/// The disparities that a row of the image can show, px.
struct RowSearch {
  float least_px = 0;
  float most_px = -1;  ///< less than the least: the row shows nothing that matters

  [[nodiscard]] bool empty() const { return most_px < least_px; }
  /// Widens this one to hold another, too.
  void add(const RowSearch& other);
};

/// Of each row of an ideal left camera. Nothing nearer than `nearest_m` is looked for.
std::vector<RowSearch> search_of(const MatchedRegion& region, const Pinhole& camera, double baseline_m,
                                 const Pose& T_body_sensor, double nearest_m);

/// The same where the whole space matters.
std::vector<RowSearch> search_everywhere(const Pinhole& camera, double baseline_m, double nearest_m);

}  // namespace floornav
