#include "perception/sight_lines.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

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
constexpr int kRowsPerBand = 16;
constexpr int kSample_px = 2;  ///< every n-th column of every n-th row stands for the rays that returned

/// A plane through `point` with `normal`, both in the sensor frame, the sensor on its positive side.
InverseDepthPlane plane_at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f k = normal / normal.dot(point);
  return {k.x(), k.y(), k.z()};
}

}  // namespace

void SightLines::add(const SightLines& more) {
  for (std::size_t c = 0; c < lowest_z_m.size(); ++c) {
    lowest_z_m[c] = std::min(lowest_z_m[c], more.lowest_z_m[c]);
    returned[c] += more.returned[c];
    unreturned[c] += more.unreturned[c];
  }
}

void SightLineTracer::trace(const Measurer& measure, const SensorView& view,
                            std::span<const SectionResult> sections, const CellWindow& window,
                            Parallel& parallel, SightLines& out) {
  find_done_cells(view, sections, window);
  find_expected_floors(view, sections);
  const auto cells = static_cast<std::size_t>(window.count());
  workers_.resize(static_cast<std::size_t>(parallel.workers()));
  for (Worker& worker : workers_) worker.lines.clear(cells);
  const int height = view.camera.height;
  const auto follow = [&](int band, int number) {
    Worker& worker = workers_[static_cast<std::size_t>(number)];
    for (int row = band * kRowsPerBand; row < std::min((band + 1) * kRowsPerBand, height); ++row) {
      measure_row(measure, view.camera.width, row, worker);
      expect_row(view, row, window, worker);
      if (row % cells_.sight_line_stride_px == 0) pass_row(measure, view, row, window, worker);
    }
  };
  parallel.run((height + kRowsPerBand - 1) / kRowsPerBand, std::ref(follow));
  out.clear(cells);
  for (const Worker& worker : workers_) out.add(worker.lines);
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

void SightLineTracer::measure_row(const Measurer& measure, int width, int row, Worker& worker) const {
  auto& depths = worker.inverse_depth;
  depths.resize(static_cast<std::size_t>(width));
  worker.gap.assign(static_cast<std::size_t>(width), Gap{});
  const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
  for (std::size_t u = 0; u < depths.size(); ++u) depths[u] = measure.inverse_depth(first + u);
  for (std::size_t begin = 0; begin < depths.size();) {
    std::size_t end = begin;
    while (end < depths.size() && !(depths[end] > 0.0F)) ++end;
    const bool at_border = begin == 0 || end == depths.size();
    const float before = begin > 0 ? depths[begin - 1] : 0.0F;
    const float after = end < depths.size() ? depths[end] : 0.0F;
    const Gap gap{static_cast<std::int32_t>(end - begin), std::max(before, after), std::min(before, after),
                  at_border};
    for (; begin < end; ++begin) worker.gap[begin] = gap;
    ++begin;
  }
}

/// Lowers the sight line of the cells under the row's rays, up to a margin before their ends.
void SightLineTracer::pass_row(const Measurer& measure, const SensorView& view, int row,
                               const CellWindow& window, Worker& worker) const {
  const Eigen::Matrix3d R = view.T_world_sensor.linear();
  const Eigen::Vector3d sensor = view.T_world_sensor.translation();
  const Eigen::Vector2d sensor_pitches = window.pitches_of(sensor);
  const double top_z = view.T_world_body.translation().z() + roi_.z_max_m;
  const double step_m = kStepPerPitch * window.lattice().pitch_m;
  const std::size_t width = worker.inverse_depth.size();
  for (std::size_t u = 0; u < width; u += static_cast<std::size_t>(cells_.sight_line_stride_px)) {
    const Measurement m = measure(static_cast<std::size_t>(row) * width + u);
    if (!m) continue;
    const Eigen::Vector3d ray =
        R * view.camera.ray(static_cast<float>(u), static_cast<float>(row)).cast<double>();
    const double per_depth = std::max(ray.head<2>().norm(), 1e-3);
    const double depth = 1.0 / static_cast<double>(m.inverse_depth);
    const double sigma = depth * depth / static_cast<double>(m.certainty);
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
    const double step = step_m / per_depth;
    const int steps = t < end ? static_cast<int>((end - t) / step) + 1 : 0;
    const Eigen::Vector2f begin =
        (sensor_pitches + t / window.lattice().pitch_m * ray.head<2>()).cast<float>();
    const Eigen::Vector2f way = (step / window.lattice().pitch_m * ray.head<2>()).cast<float>();
    const auto begin_z = static_cast<float>(sensor.z() + t * ray.z()),
               way_z = static_cast<float>(step * ray.z());
    for (int k = 0; k < steps; ++k) {
      const auto done = static_cast<float>(k);
      const std::int32_t cell = window.at_pitches(begin.x() + done * way.x(), begin.y() + done * way.y());
      if (cell < 0 || !cell_done_[static_cast<std::size_t>(cell)]) continue;
      float& lowest = worker.lines.lowest_z_m[static_cast<std::size_t>(cell)];
      lowest = std::min(lowest, begin_z + done * way_z);
    }
  }
}

/// Charges rays of the row to the cell in which each should meet floor: those that brought nothing back, and
/// a sample of the others.
void SightLineTracer::expect_row(const SensorView& view, int row, const CellWindow& window,
                                 Worker& worker) const {
  const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
  const Eigen::Matrix3f R_body = view.T_body_sensor.linear().cast<float>();
  const Eigen::Vector3f origin = view.T_body_sensor.translation().cast<float>();
  const Eigen::Vector3d sensor = view.T_world_sensor.translation();
  const float max_depth =
      std::sqrt(kExpectedSigmaShare * static_cast<float>(roi_.max_sigma_z_m) *
                static_cast<float>(view.disparity_per_inverse_depth) / view.disparity_sigma_px);
  const auto min_depth = static_cast<float>(roi_.min_range_m);
  for (std::size_t u = 0; u < worker.inverse_depth.size(); ++u) {
    const bool returned = worker.inverse_depth[u] > 0.0F;
    if (returned && (row % kSample_px != 0 || u % kSample_px != 0)) continue;
    const Eigen::Vector3f ray = view.camera.ray(static_cast<float>(u), static_cast<float>(row));
    const float expected = expected_inverse_depth(ray, R_body, origin);
    if (!(expected * max_depth > 1.0F && expected * min_depth < 1.0F)) continue;
    if (!returned && is_explained(worker.gap[u], expected, view)) continue;
    const Eigen::Vector3d p = sensor + ((R * ray) / expected).cast<double>();
    const std::int32_t cell = window.at(p.x(), p.y());
    if (cell < 0 || !cell_done_[static_cast<std::size_t>(cell)]) continue;
    if (returned)
      worker.lines.returned[static_cast<std::size_t>(cell)] += kSample_px * kSample_px;
    else
      ++worker.lines.unreturned[static_cast<std::size_t>(cell)];
  }
}

float SightLineTracer::expected_inverse_depth(const Eigen::Vector3f& ray,
                                              const Eigen::Matrix3f& R_body_sensor,
                                              const Eigen::Vector3f& origin) const {
  const float first = body_floor_.inverse_depth(ray.x(), ray.y());
  if (!(first > 0.0F)) return 0.0F;
  const Eigen::Vector3f p = origin + R_body_sensor * ray / first;
  const int section = grid_.at(p.x(), p.y());
  return section < 0 ? 0.0F
                     : expected_floor_[static_cast<std::size_t>(section)].inverse_depth(ray.x(), ray.y());
}

/// True where the image's border accounts for a missing return, or the shadow of something nearer, or a
/// surface in front of the floor that returns nothing.
bool SightLineTracer::is_explained(const Gap& gap, float expected_inverse_depth, const SensorView& view) {
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
