#include "perception/cell_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace floornav {

namespace {

/// Steeper planes have no height of their own at a place: their points count as they lie on the plane.
constexpr float kMinUpright = 0.5F;
/// A ray this close to the plane's own direction says nothing about where it meets it.
constexpr float kMinFacing = 0.02F;
constexpr std::int32_t kPointsPerPiece = 16384;

}  // namespace

void CellSorter::sort(const RoiCloud& cloud, std::span<const std::int16_t> label,
                      std::span<const SectionResult> sections, const SensorView& view,
                      const CellWindow& window, Parallel& parallel, CellPoints& out) {
  cell_.resize(cloud.size());
  placed_.resize(cloud.size());
  cut_pieces(cloud, sections);
  find_planes(sections, view);
  const auto place = [&](int number, int) {
    const Piece& piece = pieces_[static_cast<std::size_t>(number)];
    const SectionResult& result = sections[static_cast<std::size_t>(piece.section)];
    if (result.done) {
      place_points(cloud, label, piece, result.first_surfel, view, window);
    } else {
      std::fill(cell_.begin() + piece.begin, cell_.begin() + piece.end, -1);
    }
  };
  parallel.run(static_cast<int>(pieces_.size()), std::ref(place));

  out.cell_end.assign(static_cast<std::size_t>(window.count()) + 1, 0);
  for (const std::int32_t cell : cell_)
    if (cell >= 0) ++out.cell_end[static_cast<std::size_t>(cell) + 1];
  for (std::size_t c = 1; c < out.cell_end.size(); ++c) out.cell_end[c] += out.cell_end[c - 1];
  out.points.resize(static_cast<std::size_t>(out.cell_end.back()));
  // cell_end[c] is the begin of cell c until its points are in; then it is its end.
  for (std::size_t i = 0; i < cell_.size(); ++i)
    if (cell_[i] >= 0)
      out.points[static_cast<std::size_t>(out.cell_end[static_cast<std::size_t>(cell_[i])]++)] = placed_[i];
  out.cell_end.pop_back();
}

void CellSorter::cut_pieces(const RoiCloud& cloud, std::span<const SectionResult> sections) {
  pieces_.clear();
  for (int section = 0; section < static_cast<int>(sections.size()); ++section) {
    const std::int32_t end = cloud.section_end[static_cast<std::size_t>(section)];
    for (std::int32_t p = cloud.section_begin(section); p < end; p += kPointsPerPiece)
      pieces_.push_back({section, p, std::min(p + kPointsPerPiece, end)});
  }
}

void CellSorter::find_planes(std::span<const SectionResult> sections, const SensorView& view) {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  planes_.clear();
  for (const SectionResult& result : sections)
    for (const SectionPlane& found : result.planes) {
      const Eigen::Vector3f normal = found.plane.normal();
      planes_.push_back({found.plane, normal, (R * normal).z()});
    }
}

void CellSorter::place_points(const RoiCloud& cloud, std::span<const std::int16_t> label, const Piece& piece,
                              std::int16_t first_surfel, const SensorView& view, const CellWindow& window) {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  const Eigen::Vector3d sensor = view.T_world_sensor.translation();
  for (std::int32_t p = piece.begin; p < piece.end; ++p) {
    const auto i = static_cast<std::size_t>(p);
    cell_[i] = -1;
    if (label[i] != kNoPlane && label[i] < 0) continue;
    const Eigen::Vector3f ray(cloud.ray_x[i], cloud.ray_y[i], 1.0F);
    const float sigma_depth = cloud.z[i] * cloud.z[i] / cloud.certainty[i];
    float depth = cloud.z[i];
    CellPoint point{-1, 0.0F, 0.0F, 0.0F, 0.0F};
    float per_depth = (R * ray).z();  // vertical metres a metre of depth
    if (label[i] >= 0) {
      point.surfel = static_cast<std::int16_t>(first_surfel + label[i]);
      const PlaneInWorld& plane = planes_[static_cast<std::size_t>(point.surfel)];
      const float facing = -plane.normal.dot(ray);
      if (facing > kMinFacing) depth = 1.0F / plane.plane.inverse_depth(ray.x(), ray.y());
      if (plane.upright > kMinUpright) {
        per_depth = facing / plane.upright;
        point.rise_m = (depth - cloud.z[i]) * per_depth;
      }
    }
    point.var_m2 = sigma_depth * sigma_depth * per_depth * per_depth;
    point.common_m2 = roughness_m_ * roughness_m_ * per_depth * per_depth;
    const Eigen::Vector3d world = sensor + (depth * (R * ray)).cast<double>();
    point.z_m = static_cast<float>(world.z());
    cell_[i] = window.at(world.x(), world.y());
    placed_[i] = point;
  }
}

}  // namespace floornav
