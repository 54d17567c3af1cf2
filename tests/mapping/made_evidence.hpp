#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

#include "perception/evidence.hpp"

namespace floornav {

/// A surface at a place, in closed form: height and rise per metre along x and y.
struct Ground {
  double z_m = 0;
  double rise_x = 0;
  double rise_y = 0;
};

/// What stands at (x, y), m; nothing where nothing is seen.
using Scene = std::function<std::optional<Ground>(double x_m, double y_m)>;

/// A rectangle of cells, m.
struct Area {
  double x_min_m = 0;
  double x_max_m = 4;
  double y_min_m = -1;
  double y_max_m = 1;
};

/// The evidence of a sensor without error: every cell of the area, seen whole, one surfel a cell.
inline FloorEvidence see(const Scene& scene, const Area& area = {}, double pitch_m = 0.05,
                         float sigma_m = 0.002F) {
  FloorEvidence evidence;
  evidence.utime_us = 1'000'000;
  evidence.lattice = Lattice{pitch_m};
  evidence.sections.push_back({.done = true});
  const auto index = [pitch_m](double at_m) {
    return static_cast<std::int32_t>(std::lround(at_m / pitch_m));
  };
  for (std::int32_t iy = index(area.y_min_m); iy < index(area.y_max_m); ++iy) {
    for (std::int32_t ix = index(area.x_min_m); ix < index(area.x_max_m); ++ix) {
      const double x_m = evidence.lattice.center_of(ix);
      const double y_m = evidence.lattice.center_of(iy);
      const std::optional<Ground> ground = scene(x_m, y_m);
      if (!ground) continue;
      Surfel surfel;
      surfel.centroid_m = Eigen::Vector3d(x_m, y_m, ground->z_m);
      surfel.normal = Eigen::Vector3d(-ground->rise_x, -ground->rise_y, 1).normalized().cast<float>();
      surfel.points = 10;
      CellEvidence cell;
      cell.cell = {ix, iy};
      cell.surfel = static_cast<std::int16_t>(evidence.surfels.size());
      cell.points = 10;
      cell.mean_z_m = static_cast<float>(ground->z_m);
      const double corner_m = 0.5 * pitch_m * (std::abs(ground->rise_x) + std::abs(ground->rise_y));
      cell.top_z_m = static_cast<float>(ground->z_m + corner_m);
      cell.var_z_m2 = sigma_m * sigma_m;
      evidence.surfels.push_back(surfel);
      evidence.cells.push_back(cell);
    }
  }
  return evidence;
}

inline Scene flat(double z_m = 0) {
  return [z_m](double, double) { return Ground{z_m}; };
}

inline bool inside(double x_m, double y_m, const Area& area) {
  return x_m > area.x_min_m && x_m < area.x_max_m && y_m > area.y_min_m && y_m < area.y_max_m;
}

/// `scene` with another height inside the area.
inline Scene with_block(Scene scene, Area area, double z_m) {
  return [=](double x_m, double y_m) {
    return inside(x_m, y_m, area) ? std::optional(Ground{z_m}) : scene(x_m, y_m);
  };
}

/// `scene` with nothing seen inside the area.
inline Scene with_hole(Scene scene, Area area) {
  return [=](double x_m, double y_m) { return inside(x_m, y_m, area) ? std::nullopt : scene(x_m, y_m); };
}

}  // namespace floornav
