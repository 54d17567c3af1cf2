#include "perception/missing_floor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "perception/row_bands.hpp"

namespace floornav {

namespace {

/// Floor is expected back only where depth is this much more certain than the ROI's bound: far floor often
/// returns nothing.
constexpr float kExpectedSigmaShare = 0.5F;
constexpr float kShadowFactor = 1.5F;
constexpr float kShadowMargin_px = 4.0F;
constexpr float kBorder_px = 10.0F;
constexpr std::int32_t kMinRays = 3;  ///< without return, for a cell to miss its floor
constexpr std::int32_t kPerReturned = 4;
constexpr int kCellsPerPiece = 64;

constexpr int kAtOnce_px = 16;

bool all_returned(const float* depths) {
  return Eigen::Map<const Eigen::Array<float, kAtOnce_px, 1>>(depths).minCoeff() > 0.0F;
}

/// A plane through `point` with `normal`, both in the sensor frame, the sensor on its positive side.
InverseDepthPlane plane_at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f k = normal / normal.dot(point);
  return {k.x(), k.y(), k.z()};
}

}  // namespace

void MissingFloorFinder::find(const MeasuredImage& image, const SensorView& view,
                              std::span<const SectionResult> sections, const CellWindow& window,
                              const CellSections& cell_sections, const CellPoints& points,
                              const std::function<bool(std::int32_t)>& is_asked, Parallel& parallel,
                              std::vector<std::uint8_t>& missing) {
  find_expected_floors(view, sections);
  const Aim aim{view.T_world_sensor.linear().cast<float>(),
                view.T_body_sensor.linear().cast<float>(),
                view.T_body_sensor.translation().cast<float>(),
                view.T_world_sensor.translation(),
                std::sqrt(kExpectedSigmaShare * static_cast<float>(roi_.max_sigma_z_m) *
                          static_cast<float>(view.disparity_per_inverse_depth) / view.disparity_sigma_px),
                static_cast<float>(roi_.min_range_m)};
  workers_.resize(static_cast<std::size_t>(parallel.workers()));
  for (Charges& charges : workers_) {
    charges.count.resize(std::max(charges.count.size(), static_cast<std::size_t>(window.count())), 0);
    charges.cells.clear();
  }
  const RowBands rows{image.height};
  const auto charge = [&](int band, int worker) {
    for (int row = rows.first(band); row < rows.end(band); ++row)
      charge_row(image, view, row, aim, window, workers_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(rows.count(), std::ref(charge));

  unreturned_.resize(std::max(unreturned_.size(), static_cast<std::size_t>(window.count())), 0);
  suspects_.clear();
  for (Charges& charges : workers_)
    for (const std::int32_t cell : charges.cells) {
      std::int32_t& count = unreturned_[static_cast<std::size_t>(cell)];
      if (count == 0) suspects_.push_back(cell);
      count += std::exchange(charges.count[static_cast<std::size_t>(cell)], 0);
    }
  const auto judge = [&](int piece, int) {
    const auto end = std::min(suspects_.size(), static_cast<std::size_t>(piece + 1) * kCellsPerPiece);
    for (auto i = static_cast<std::size_t>(piece) * kCellsPerPiece; i < end; ++i) {
      const std::int32_t cell = suspects_[i];
      const auto c = static_cast<std::size_t>(cell);
      const std::int32_t unreturned = std::exchange(unreturned_[c], 0);
      const int section = cell_sections.of(cell);
      if (unreturned < kMinRays || !is_asked(cell) || !points.of(cell).empty()) continue;
      if (section < 0 || !sections[static_cast<std::size_t>(section)].done) continue;
      missing[c] = is_missing(cell, image, view, aim, window, section, unreturned) ? 1 : 0;
    }
  };
  parallel.run((static_cast<int>(suspects_.size()) + kCellsPerPiece - 1) / kCellsPerPiece, std::ref(judge));
}

/// A section's own floor, else that of the next section towards the robot, else the plane on which the robot
/// stands.
void MissingFloorFinder::find_expected_floors(const SensorView& view,
                                              std::span<const SectionResult> sections) {
  const Pose T_sensor_body = view.T_body_sensor.inverse();
  body_floor_ =
      plane_at(T_sensor_body.translation().cast<float>(), T_sensor_body.linear().col(2).cast<float>());
  expected_floor_.assign(static_cast<std::size_t>(grid_.count()), body_floor_);
  const auto columns = static_cast<std::size_t>(grid_.y_res());
  for (std::size_t s = 0; s < expected_floor_.size(); ++s) {
    if (s >= columns) expected_floor_[s] = expected_floor_[s - columns];
    if (s < sections.size() && !sections[s].planes.empty() && sections[s].planes.front().dominant)
      expected_floor_[s] = sections[s].planes.front().plane;
  }
}

/// 0 where the ray is not aimed at floor that should come back.
float MissingFloorFinder::expected_inverse_depth(const Eigen::Vector3f& ray, const Aim& aim) const {
  const float first = body_floor_.inverse_depth(ray.x(), ray.y());
  if (!(first > 0.0F)) return 0.0F;
  const Eigen::Vector3f p = aim.origin + aim.R_body_sensor * ray / first;
  const int section = grid_.at(p.x(), p.y());
  if (section < 0) return 0.0F;
  const float expected = expected_floor_[static_cast<std::size_t>(section)].inverse_depth(ray.x(), ray.y());
  return expected * aim.max_depth > 1.0F && expected * aim.min_depth < 1.0F ? expected : 0.0F;
}

std::int32_t MissingFloorFinder::aimed_cell(const Eigen::Vector3f& ray, float expected, const Aim& aim,
                                            const CellWindow& window) const {
  const Eigen::Vector3d p = aim.sensor + ((aim.R_world_sensor * ray) / expected).cast<double>();
  return window.at(p.x(), p.y());
}

void MissingFloorFinder::charge_row(const MeasuredImage& image, const SensorView& view, int row,
                                    const Aim& aim, const CellWindow& window, Charges& charges) const {
  const float* const depths = image.inverse_depth.data() + image.row_begin(row);
  const auto next = [&](int column, bool returned) {
    while (column < image.width && (depths[column] > 0.0F) != returned) ++column;
    return column;
  };
  for (int begin = 0; begin < image.width;) {
    if (begin + kAtOnce_px <= image.width && all_returned(depths + begin)) {
      begin += kAtOnce_px;
      continue;
    }
    begin = next(begin, false);
    if (begin == image.width) return;
    const int end = next(begin, true);
    const float before = begin > 0 ? depths[begin - 1] : 0.0F;
    const float after = end < image.width ? depths[end] : 0.0F;
    charge_gap(
        {begin, end, std::max(before, after), std::min(before, after), begin == 0 || end == image.width},
        view, row, aim, window, charges);
    begin = end;
  }
}

void MissingFloorFinder::charge_gap(const Gap& gap, const SensorView& view, int row, const Aim& aim,
                                    const CellWindow& window, Charges& charges) const {
  for (int column = gap.begin; column < gap.end; ++column) {
    const Eigen::Vector3f ray = view.camera.ray(static_cast<float>(column), static_cast<float>(row));
    const float expected = expected_inverse_depth(ray, aim);
    if (!(expected > 0.0F) || is_explained(gap, expected, view)) continue;
    const std::int32_t cell = aimed_cell(ray, expected, aim, window);
    if (cell < 0) continue;
    if (charges.count[static_cast<std::size_t>(cell)]++ == 0) charges.cells.push_back(cell);
  }
}

/// Looks at the pixels that the cell covers, as it lies on its section's floor.
bool MissingFloorFinder::is_missing(std::int32_t cell, const MeasuredImage& image, const SensorView& view,
                                    const Aim& aim, const CellWindow& window, int section,
                                    std::int32_t unreturned) const {
  const InverseDepthPlane& floor = expected_floor_[static_cast<std::size_t>(section)];
  const Eigen::Vector3f normal = aim.R_world_sensor * floor.normal();  // up
  const CellIndex index = window.cell(cell);
  const double half = 0.5 * window.lattice().pitch_m;
  Eigen::Array2f low = Eigen::Array2f::Constant(1e6F), high = Eigen::Array2f::Constant(-1e6F);
  for (const double dx : {-half, half})
    for (const double dy : {-half, half}) {
      const Eigen::Vector3d place(window.lattice().center_of(index.ix) + dx,
                                  window.lattice().center_of(index.iy) + dy, aim.sensor.z());
      Eigen::Vector3f p = (place - aim.sensor).cast<float>();
      p.z() = -(floor.distance_m() + normal.head<2>().dot(p.head<2>())) / normal.z();
      const Eigen::Vector3f in_sensor = aim.R_world_sensor.transpose() * p;
      if (!(in_sensor.z() > 0.0F)) return false;
      const Eigen::Array2f pixel = view.camera.project(in_sensor).array();
      low = low.min(pixel);
      high = high.max(pixel);
    }
  const auto side = [](float value, int count) {
    return static_cast<int>(std::clamp(value, 0.0F, static_cast<float>(count)));
  };
  std::int32_t returned = 0;
  for (int row = side(low.y(), image.height); row < side(high.y() + 2.0F, image.height); ++row)
    for (int column = side(low.x(), image.width); column < side(high.x() + 2.0F, image.width); ++column) {
      if (!(image.inverse_depth[image.row_begin(row) + static_cast<std::size_t>(column)] > 0.0F)) continue;
      const Eigen::Vector3f ray = view.camera.ray(static_cast<float>(column), static_cast<float>(row));
      const float expected = expected_inverse_depth(ray, aim);
      if (!(expected > 0.0F) || aimed_cell(ray, expected, aim, window) != cell) continue;
      if (kPerReturned * ++returned > unreturned) return false;
    }
  return true;
}

/// True where the image's border accounts for a missing return, or the shadow of something nearer, or a
/// surface in front of the floor that returns nothing.
bool MissingFloorFinder::is_explained(const Gap& gap, float expected_inverse_depth, const SensorView& view) {
  const auto per_disparity = static_cast<float>(view.disparity_per_inverse_depth);
  const auto width = static_cast<float>(gap.end - gap.begin);
  if (gap.at_border &&
      width <= std::max(kBorder_px, per_disparity * expected_inverse_depth) + kShadowMargin_px)
    return true;
  const float nearer_px = 1.0F / per_disparity;
  if (gap.farthest_inverse_depth > expected_inverse_depth + nearer_px) return true;
  const float jump = gap.nearest_inverse_depth - expected_inverse_depth;
  return jump > nearer_px && width <= kShadowFactor * jump * per_disparity + kShadowMargin_px;
}

}  // namespace floornav
