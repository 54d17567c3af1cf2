#include "mapping/frame_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>

#include "mapping/evidence_reader.hpp"

namespace floornav {
namespace {

constexpr std::size_t kLeastCommonCells = 50;
constexpr float kLeastUpright = 0.87F;  // of a normal's z: 30 degrees
constexpr float kViewVar_m2 = 1e-5F;

/// A cell that frame and map both know as a plane, or where the frame's floor is held against a level one.
struct CommonCell {
  Eigen::Vector2d place_m;  ///< from the body
  double above_map_m;
  double weight;  ///< 1 / variance of above_map_m
};

bool is_upright_plane(const CellEvidence& cell, const FloorEvidence& frame) {
  return cell.points >= Level::kTrusted && cell.surfel >= 0 && EvidenceReader::is_valid(cell, frame) &&
         std::abs(frame.surfels[static_cast<std::size_t>(cell.surfel)].normal.z()) >= kLeastUpright;
}

Eigen::Vector2d from_body_m(const CellEvidence& cell, const FloorEvidence& frame) {
  return Eigen::Vector2d(frame.lattice.center_of(cell.cell.ix), frame.lattice.center_of(cell.cell.iy)) -
         frame.T_world_body.translation().head<2>();
}

std::vector<CommonCell> common_cells(const FloorEvidence& frame, const MapTiles& map) {
  constexpr double kFarthest_m = 0.2;
  std::vector<CommonCell> common;
  common.reserve(frame.cells.size());
  for (const CellEvidence& cell : frame.cells) {
    if (!is_upright_plane(cell, frame)) continue;
    const CellMemory memory = map.cell(cell.cell);
    const Surface* const surface = memory.decider();
    if (surface == nullptr || surface->column) continue;
    const double above_m = static_cast<double>(cell.mean_z_m - surface->z_m);
    if (std::abs(above_m) > kFarthest_m) continue;
    common.push_back({from_body_m(cell, frame), above_m,
                      1.0 / static_cast<double>(cell.var_z_m2 + surface->var_m2 + kViewVar_m2)});
  }
  return common;
}

std::vector<CommonCell> floor_cells(const FloorEvidence& frame) {
  std::vector<CommonCell> floor;
  for (const CellEvidence& cell : frame.cells) {
    if (!is_upright_plane(cell, frame) || !frame.surfels[static_cast<std::size_t>(cell.surfel)].dominant)
      continue;
    floor.push_back({from_body_m(cell, frame), static_cast<double>(cell.mean_z_m),
                     1.0 / static_cast<double>(cell.var_z_m2 + kViewVar_m2)});
  }
  return floor;
}

/// Normal equations of lift and rises, summed cell by cell.
struct NormalSums {
  double one = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  ///< the matrix' upper half
  double z = 0, xz = 0, yz = 0;                          ///< right-hand side

  void add(const CommonCell& cell, double weight) {
    const double wx = weight * cell.place_m.x();
    const double wy = weight * cell.place_m.y();
    const double wz = weight * cell.above_map_m;
    one += weight;
    x += wx;
    y += wy;
    xx += wx * cell.place_m.x();
    xy += wx * cell.place_m.y();
    yy += wy * cell.place_m.y();
    z += wz;
    xz += wz * cell.place_m.x();
    yz += wz * cell.place_m.y();
  }
  [[nodiscard]] Eigen::Vector3d solve() const {
    constexpr double kUsual = 0.02;  // m and m/m, 1 sigma of a pose's error
    Eigen::Matrix3d normal = Eigen::Vector3d::Constant(1 / (kUsual * kUsual)).asDiagonal();
    normal += (Eigen::Matrix3d() << one, x, y, x, xx, xy, y, xy, yy).finished();
    return normal.ldlt().solve(Eigen::Vector3d(z, xz, yz));
  }
};

/// Lift and rises by least squares, in which a cell whose rest is `scale_m` has a quarter of its weight.
Eigen::Vector3d fit(const std::vector<CommonCell>& cells, const Eigen::Vector3d& before, double scale_m) {
  const double per_square_m2 = 1 / (scale_m * scale_m);
  NormalSums sums;
  for (const CommonCell& cell : cells) {
    const double rest_m =
        cell.above_map_m - before[0] - before[1] * cell.place_m.x() - before[2] * cell.place_m.y();
    const double damping = 1 + per_square_m2 * rest_m * rest_m;
    sums.add(cell, cell.weight / (damping * damping));
  }
  return sums.solve();
}

double median_difference(std::vector<CommonCell>& cells) {
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
  std::nth_element(cells.begin(), middle, cells.end(),
                   [](const CommonCell& a, const CommonCell& b) { return a.above_map_m < b.above_map_m; });
  return middle->above_map_m;
}

HeightError no_error(const FloorEvidence& frame) {
  HeightError error;
  error.center_m = frame.T_world_body.translation().head<2>();
  return error;
}

HeightError plane_of_error(const FloorEvidence& frame, std::vector<CommonCell> cells,
                           const AlignmentSettings& settings) {
  HeightError error = no_error(frame);
  if (cells.size() < kLeastCommonCells) return error;
  Eigen::Vector3d found(median_difference(cells), 0, 0);
  for (const double scale_m : {0.08, 0.04, 0.02, 0.02, 0.02}) found = fit(cells, found, scale_m);
  const double max_rise = std::tan(settings.max_tilt_deg * std::numbers::pi / 180);
  error.lift_m = std::clamp(found[0], -settings.max_lift_m, settings.max_lift_m);
  const Eigen::Vector2d rise = found.tail<2>();
  error.rise = rise * std::min(1.0, max_rise / std::max(rise.norm(), 1e-9));
  return error;
}

}  // namespace

HeightError find_height_error(const FloorEvidence& frame, const MapTiles& map,
                              const AlignmentSettings& settings) {
  return settings.enabled ? plane_of_error(frame, common_cells(frame, map), settings) : no_error(frame);
}

HeightError find_level_error(const FloorEvidence& frame, const AlignmentSettings& settings) {
  constexpr double kMostLift_m = 0.03;
  const double most_rise = std::tan(std::numbers::pi / 180);
  if (!settings.enabled) return no_error(frame);
  const HeightError error = plane_of_error(frame, floor_cells(frame), settings);
  return std::abs(error.lift_m) < kMostLift_m && error.rise.norm() < most_rise ? error : no_error(frame);
}

FloorEvidence corrected(const FloorEvidence& frame, const HeightError& error) {
  FloorEvidence result = frame;
  for (CellEvidence& cell : result.cells) {
    const auto too_high_m = static_cast<float>(
        error.at(frame.lattice.center_of(cell.cell.ix), frame.lattice.center_of(cell.cell.iy)));
    cell.mean_z_m -= too_high_m;
    cell.top_z_m -= too_high_m;
    cell.ray_z_m -= too_high_m;
  }
  for (Surfel& surfel : result.surfels) {
    surfel.centroid_m.z() -= error.at(surfel.centroid_m.x(), surfel.centroid_m.y());
    surfel.normal.head<2>() += surfel.normal.z() * error.rise.cast<float>();
    surfel.normal.normalize();
  }
  return result;
}

}  // namespace floornav
