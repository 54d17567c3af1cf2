#include "perception/sight_lines.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

namespace {

constexpr float kEndMargin_sigmas = 3.0F;
constexpr double kStepPerPitch = 0.7;  ///< along the floor, so that few cells under a ray are stepped over
/// Floor is expected back only where depth is this much more certain than the ROI's bound: far floor often
/// returns nothing.
constexpr float kExpectedSigmaShare = 0.5F;
constexpr float kShadowFactor = 1.5F;
constexpr float kShadowMargin_px = 4.0F;
constexpr float kBorder_px = 10.0F;

/// A plane through `point` with `normal`, both in the sensor frame, the sensor on its positive side.
InverseDepthPlane plane_at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f k = normal / normal.dot(point);
  return {k.x(), k.y(), k.z()};
}

}  // namespace

void SightLineTracer::trace(const DepthFrame& frame, const SensorView& view,
                            std::span<const SectionResult> sections, const CellWindow& window,
                            SightLines& out) {
  const auto cells = static_cast<std::size_t>(window.count());
  out.lowest_z_m.assign(cells, std::numeric_limits<float>::infinity());
  out.returned.assign(cells, 0);
  out.unreturned.assign(cells, 0);
  find_done_cells(view, sections, window);
  find_expected_floors(view, sections);
  for (int row = 0; row < frame.camera.height; ++row) {
    measure_row(frame, row);
    expect_row(view, row, window, out);
    if (row % cells_.sight_line_stride_px == 0) pass_row(view, row, window, out);
  }
}

void SightLineTracer::find_done_cells(const SensorView& view, std::span<const SectionResult> sections,
                                      const CellWindow& window) {
  cell_done_.assign(static_cast<std::size_t>(window.count()), 0);
  const Pose T_body_world = view.T_world_body.inverse();
  for (std::int32_t number = 0; number < window.count(); ++number) {
    const CellIndex cell = window.cell(number);
    const Eigen::Vector3d center(window.lattice().center_of(cell.ix), window.lattice().center_of(cell.iy),
                                 view.T_world_body.translation().z());
    const Eigen::Vector3f p = (T_body_world * center).cast<float>();
    const int section = grid_.at(p.x(), p.y());
    if (section >= 0 && sections[static_cast<std::size_t>(section)].done)
      cell_done_[static_cast<std::size_t>(number)] = 1;
  }
}

/// A section's own floor, else that of the next section towards the robot, else the plane on which the robot
/// stands.
void SightLineTracer::find_expected_floors(const SensorView& view, std::span<const SectionResult> sections) {
  const Pose T_sensor_body = view.T_body_sensor.inverse();
  body_floor_ =
      plane_at(T_sensor_body.translation().cast<float>(), T_sensor_body.linear().col(2).cast<float>());
  expected_floor_.assign(sections.size(), body_floor_);
  const auto columns = static_cast<std::size_t>(grid_.y_res());
  for (std::size_t s = 0; s < sections.size(); ++s) {
    if (s >= columns) expected_floor_[s] = expected_floor_[s - columns];
    if (!sections[s].planes.empty() && sections[s].planes.front().dominant)
      expected_floor_[s] = sections[s].planes.front().plane;
  }
}

void SightLineTracer::measure_row(const DepthFrame& frame, int row) {
  const int width = frame.camera.width;
  row_.resize(static_cast<std::size_t>(width));
  gap_.assign(static_cast<std::size_t>(width), Gap{});
  const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
  for (std::size_t u = 0; u < row_.size(); ++u)
    row_[u] = measure(frame, first + u, static_cast<float>(roi_.roughness_m));
  for (std::size_t begin = 0; begin < row_.size();) {
    std::size_t end = begin;
    while (end < row_.size() && !row_[end]) ++end;
    const bool at_border = begin == 0 || end == row_.size();
    const float before = begin > 0 ? row_[begin - 1].inverse_depth : 0.0F;
    const float after = end < row_.size() ? row_[end].inverse_depth : 0.0F;
    const Gap gap{static_cast<std::int32_t>(end - begin), std::max(before, after), std::min(before, after),
                  at_border};
    for (; begin < end; ++begin) gap_[begin] = gap;
    ++begin;
  }
}

/// Lowers the sight line of the cells under the row's rays, up to a margin before their ends.
void SightLineTracer::pass_row(const SensorView& view, int row, const CellWindow& window,
                               SightLines& out) const {
  const Eigen::Matrix3d R = view.T_world_sensor.linear();
  const Eigen::Vector3d sensor = view.T_world_sensor.translation();
  const double top_z = view.T_world_body.translation().z() + roi_.z_max_m;
  const double step_m = kStepPerPitch * window.lattice().pitch_m;
  for (std::size_t u = 0; u < row_.size(); u += static_cast<std::size_t>(cells_.sight_line_stride_px)) {
    if (!row_[u]) continue;
    const Eigen::Vector3d ray =
        R * view.camera.ray(static_cast<float>(u), static_cast<float>(row)).cast<double>();
    const double per_depth = std::max(ray.head<2>().norm(), 1e-3);
    const double depth = 1.0 / static_cast<double>(row_[u].inverse_depth);
    const double sigma = depth * depth / static_cast<double>(row_[u].certainty);
    double t = 0.0;
    double end =
        depth - static_cast<double>(kEndMargin_sigmas) * sigma - window.lattice().pitch_m / per_depth;
    if (sensor.z() > top_z) {
      if (ray.z() >= 0.0) continue;
      t = (top_z - sensor.z()) / ray.z();
    } else if (ray.z() > 0.0) {
      end = std::min(end, (top_z - sensor.z()) / ray.z());
    }
    end = std::min(end, (roi_.x_max_m + std::max(roi_.y_max_m, -roi_.y_min_m)) / per_depth);
    for (; t < end; t += step_m / per_depth) {
      const Eigen::Vector3d p = sensor + t * ray;
      const std::int32_t cell = window.at(p.x(), p.y());
      if (cell < 0 || !cell_done_[static_cast<std::size_t>(cell)]) continue;
      float& lowest = out.lowest_z_m[static_cast<std::size_t>(cell)];
      lowest = std::min(lowest, static_cast<float>(p.z()));
    }
  }
}

/// Charges each ray of the row to the cell in which it should meet floor.
void SightLineTracer::expect_row(const SensorView& view, int row, const CellWindow& window,
                                 SightLines& out) const {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  const Eigen::Vector3d sensor = view.T_world_sensor.translation();
  const float max_depth =
      std::sqrt(kExpectedSigmaShare * static_cast<float>(roi_.max_sigma_z_m) *
                static_cast<float>(view.disparity_per_inverse_depth) / view.disparity_sigma_px);
  const auto min_depth = static_cast<float>(roi_.min_range_m);
  for (int column = 0; column < view.camera.width; ++column) {
    const Eigen::Vector3f ray = view.camera.ray(static_cast<float>(column), static_cast<float>(row));
    const float expected = expected_inverse_depth(ray, view);
    if (!(expected * max_depth > 1.0F && expected * min_depth < 1.0F)) continue;
    const auto u = static_cast<std::size_t>(column);
    if (!row_[u] && is_explained(column, expected, view)) continue;
    const Eigen::Vector3d p = sensor + ((R * ray) / expected).cast<double>();
    const std::int32_t cell = window.at(p.x(), p.y());
    if (cell < 0 || !cell_done_[static_cast<std::size_t>(cell)]) continue;
    ++(row_[u] ? out.returned : out.unreturned)[static_cast<std::size_t>(cell)];
  }
}

float SightLineTracer::expected_inverse_depth(const Eigen::Vector3f& ray, const SensorView& view) const {
  const float first = body_floor_.inverse_depth(ray.x(), ray.y());
  if (!(first > 0.0F)) return 0.0F;
  const Eigen::Vector3f p = (view.T_body_sensor * (ray / first).cast<double>()).cast<float>();
  const int section = grid_.at(p.x(), p.y());
  return section < 0 ? 0.0F
                     : expected_floor_[static_cast<std::size_t>(section)].inverse_depth(ray.x(), ray.y());
}

/// True where the image's border accounts for a missing return, or the shadow of something nearer, or a
/// surface in front of the floor that returns nothing.
bool SightLineTracer::is_explained(int column, float expected_inverse_depth, const SensorView& view) const {
  const Gap& gap = gap_[static_cast<std::size_t>(column)];
  const auto per_disparity = static_cast<float>(view.disparity_per_inverse_depth);
  const auto width = static_cast<float>(gap.width);
  if (gap.at_border &&
      width <= std::max(kBorder_px, per_disparity * expected_inverse_depth) + kShadowMargin_px)
    return true;
  const float nearer_px = 1.0F / per_disparity;
  if (gap.farthest_inverse_depth > expected_inverse_depth + nearer_px) return true;
  const float jump = gap.nearest_inverse_depth - expected_inverse_depth;
  return jump > nearer_px && width <= kShadowFactor * jump * per_disparity + kShadowMargin_px;
}

}  // namespace floornav
