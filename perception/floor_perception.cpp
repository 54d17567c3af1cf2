#include "perception/floor_perception.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "perception/noise_correlation.hpp"
#include "perception/surfels.hpp"

namespace floornav {

namespace {

/// Estimated work of a point, from the ROI to its cell.
constexpr std::int64_t kWorkPerPoint_ns = 1500;
constexpr int kCellsPerPiece = 512;
constexpr double kLeastDepth_m = 0.1;

PerceptionSettings checked(const PerceptionSettings& settings) {
  const RoiSettings& roi = settings.roi;
  if (!(roi.x_min_m < roi.x_max_m && roi.y_min_m < roi.y_max_m && roi.z_min_m < roi.z_max_m))
    throw std::invalid_argument("roi: each minimum must be less than its maximum");
  const int planes = settings.sections.x_res * settings.sections.y_res * (settings.planes.max_planes + 1);
  if (planes > std::numeric_limits<std::int16_t>::max())
    throw std::invalid_argument("sections and planes.max_planes allow more than 32767 planes a frame");
  return settings;
}

/// How wide a cell is in the image, as seen at a height.
float width_px(CellIndex cell, float z_m, const Lattice& lattice, const SensorView& view) {
  const Eigen::Vector3d middle(lattice.center_of(cell.ix), lattice.center_of(cell.iy),
                               static_cast<double>(z_m));
  const double depth_m = view.T_world_sensor.linear().col(2).dot(middle - view.T_world_sensor.translation());
  return view.camera.fx * static_cast<float>(lattice.pitch_m / std::max(depth_m, kLeastDepth_m));
}

}  // namespace

FloorPerception::FloorPerception(const PerceptionSettings& settings, const RobotSettings& robot)
    : settings_(checked(settings)),
      robot_(robot),
      grid_(settings.roi, settings.sections),
      measurer_(settings.roi.roughness_m),
      clipper_(settings.roi, grid_),
      outlier_remover_(settings.outliers),
      plane_finder_(settings.planes, robot),
      cell_sorter_(settings.roi),
      tracer_(settings.roi, settings.cells, grid_),
      memory_(static_cast<std::size_t>(grid_.count())) {}

const FloorEvidence& FloorPerception::process(const DepthFrame& frame, const Pose& T_world_body,
                                              Parallel& parallel, const Admission& admit,
                                              const StageEnd& end_stage) {
  const SensorView view(frame, T_world_body);
  begin(frame, view, parallel);
  end_stage(PerceptionStage::kRoi);
  order_rows();
  for (const int row : rows_) {
    admit_row(row, admit);
    for (const int section : row_sections_) remove_section_outliers(section, frame.camera, parallel);
    end_stage(PerceptionStage::kOutliers);
    find_row_planes(frame.utime_us, view, parallel);
    end_stage(PerceptionStage::kPlanes);
  }
  collect_surfels();
  collect_cells(view, parallel);
  remember(view);
  end_stage(PerceptionStage::kCells);
  return evidence_;
}

/// Makes the frame's points; empties what the frame before has left.
void FloorPerception::begin(const DepthFrame& frame, const SensorView& view, Parallel& parallel) {
  const auto workers = static_cast<std::size_t>(parallel.workers());
  section_scratch_.resize(workers);
  cell_scratch_.resize(workers);
  evidence_.utime_us = frame.utime_us;
  evidence_.T_world_body = view.T_world_body;
  evidence_.T_body_sensor = frame.T_body_sensor;
  evidence_.lattice.pitch_m = settings_.cells.pitch_m;
  measurer_.begin(frame);
  evidence_.pixels = clipper_.clip(frame, measurer_, view, parallel, cloud_);
  results_.resize(static_cast<std::size_t>(grid_.count()));
  for (SectionResult& result : results_) {
    result.done = false;
    result.planes.clear();
    result.surfels.clear();
  }
  keep_.resize(cloud_.size());
  label_.assign(cloud_.size(), kOutlier);
  floor_agreement_.clear();
}

/// The nearest row, then those that have waited too long, then the others from near to far.
void FloorPerception::order_rows() {
  const auto is_starved = [this](int row) {
    for (int iy = 0; iy < grid_.y_res(); ++iy)
      if (memory_[static_cast<std::size_t>(row * grid_.y_res() + iy)].age >= kMaxAge) return true;
    return false;
  };
  rows_.clear();
  for (int row = 0; row < grid_.x_res(); ++row)
    if (row == 0 || is_starved(row)) rows_.push_back(row);
  for (int row = 1; row < grid_.x_res(); ++row)
    if (!is_starved(row)) rows_.push_back(row);
}

/// The row's sections that there is time for.
void FloorPerception::admit_row(int row, const Admission& admit) {
  row_sections_.clear();
  for (int iy = 0; iy < grid_.y_res(); ++iy) {
    const int section = row * grid_.y_res() + iy;
    if (!admit(kWorkPerPoint_ns * cloud_.section_size(section))) continue;
    results_[static_cast<std::size_t>(section)].done = true;
    row_sections_.push_back(section);
  }
}

void FloorPerception::remove_section_outliers(int section, const Pinhole& camera, Parallel& parallel) {
  const auto begin = static_cast<std::size_t>(cloud_.section_begin(section));
  const auto size = static_cast<std::size_t>(cloud_.section_size(section));
  const auto part = [&](const auto& values) { return std::span(values).subspan(begin, size); };
  const std::span<std::uint8_t> keep = std::span(keep_).subspan(begin, size);
  const ImagePoints points{{part(cloud_.x), part(cloud_.y), part(cloud_.z)}, part(cloud_.pixel), camera};
  evidence_.pixels.outliers += outlier_remover_.remove(points, parallel, keep);
  for (std::size_t i = 0; i < size; ++i) label_[begin + i] = keep[i] ? kNoPlane : kOutlier;
}

/// The largest section first, so that the workers end together; then the floors agree, and the surfels are
/// made.
void FloorPerception::find_row_planes(std::int64_t utime_us, const SensorView& view, Parallel& parallel) {
  std::sort(row_sections_.begin(), row_sections_.end(), [this](int a, int b) {
    const std::int32_t size_a = cloud_.section_size(a), size_b = cloud_.section_size(b);
    return size_a != size_b ? size_a > size_b : a < b;
  });
  const int count = static_cast<int>(row_sections_.size());
  const auto find = [&](int index, int worker) {
    find_section_planes(row_sections_[static_cast<std::size_t>(index)], utime_us, view,
                        section_scratch_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(count, std::ref(find));
  agree_on_floor();
  const auto make = [&](int index, int worker) {
    const int section = row_sections_[static_cast<std::size_t>(index)];
    SectionResult& result = results_[static_cast<std::size_t>(section)];
    make_surfels(cloud_, section, result.planes, label_, view, robot_,
                 cell_scratch_[static_cast<std::size_t>(worker)].sums, result.surfels);
  };
  parallel.run(count, std::ref(make));
}

void FloorPerception::find_section_planes(int section, std::int64_t utime_us, const SensorView& view,
                                          SectionScratch& scratch) {
  Random seed(static_cast<std::uint64_t>(settings_.planes.seed) ^
              (static_cast<std::uint64_t>(section) << 48) ^ static_cast<std::uint64_t>(utime_us));
  const auto s = static_cast<std::size_t>(section);
  plane_finder_.find(cloud_, section, view, memory_[s].floor_normal, seed.next(), label_, scratch,
                     results_[s].planes);
}

/// The floors of the row's sections agree with each other and with those of the nearer rows.
void FloorPerception::agree_on_floor() {
  std::sort(row_sections_.begin(), row_sections_.end());
  const auto floor_of = [&](int section) -> SectionPlane* {
    auto& planes = results_[static_cast<std::size_t>(section)].planes;
    return !planes.empty() && planes.front().dominant ? &planes.front() : nullptr;
  };
  for (const int section : row_sections_)
    if (const SectionPlane* floor = floor_of(section)) floor_agreement_.add(floor->fit);
  for (const int section : row_sections_)
    if (SectionPlane* floor = floor_of(section))
      floor->plane = floor_agreement_.settle(floor->fit, floor->plane);
}

void FloorPerception::collect_surfels() {
  evidence_.surfels.clear();
  for (SectionResult& result : results_) {
    result.first_surfel = static_cast<std::int16_t>(evidence_.surfels.size());
    evidence_.surfels.insert(evidence_.surfels.end(), result.surfels.begin(), result.surfels.end());
  }
}

void FloorPerception::collect_cells(const SensorView& view, Parallel& parallel) {
  const CellWindow window(evidence_.lattice, settings_.roi, view.T_world_body);
  cell_sorter_.sort(cloud_, label_, results_, view, window, parallel, cell_points_);
  tracer_.trace(measurer_, view, results_, window, parallel, sight_lines_);
  find_seen_cells(window);
  evidence_.cells.assign(seen_cells_.size(), {});
  deciders_.resize(seen_cells_.size());
  rises_.assign(static_cast<std::size_t>(window.count()), {});
  const float alike_px = alike_length_px(cloud_, label_, results_);
  const int count = static_cast<int>(seen_cells_.size());
  const int pieces = (count + kCellsPerPiece - 1) / kCellsPerPiece;
  const auto decide = [&](int piece, int worker) {
    for (int i = piece * kCellsPerPiece; i < std::min(count, (piece + 1) * kCellsPerPiece); ++i)
      decide_cell(static_cast<std::size_t>(i), cell_scratch_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(pieces, std::ref(decide));
  const auto summarize = [&](int piece, int worker) {
    for (int i = piece * kCellsPerPiece; i < std::min(count, (piece + 1) * kCellsPerPiece); ++i)
      summarize_seen_cell(static_cast<std::size_t>(i), window, view, alike_px,
                          cell_scratch_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(pieces, std::ref(summarize));
}

/// Finds what decides a seen cell, and how far its points are above it.
void FloorPerception::decide_cell(std::size_t i, CellScratch& scratch) {
  const auto points = cell_points_.of(seen_cells_[i]);
  DecidingSurfel& decider = deciders_[i];
  decider =
      points.empty() ? DecidingSurfel{} : find_deciding_surfel(points, evidence_.surfels.size(), scratch);
  if (decider.surfel < 0) return;
  const bool floor = evidence_.surfels[static_cast<std::size_t>(decider.surfel)].dominant;
  decider.rise.group = floor ? CellRise::kFloor : decider.surfel;
  rises_[static_cast<std::size_t>(seen_cells_[i])] = decider.rise;
}

void FloorPerception::summarize_seen_cell(std::size_t i, const CellWindow& window, const SensorView& view,
                                          float alike_px, CellScratch& scratch) {
  const std::int32_t number = seen_cells_[i];
  const auto points = cell_points_.of(number);
  CellEvidence& cell = evidence_.cells[i];
  cell.cell = window.cell(number);
  if (sight_lines_.passed(number)) cell.ray_z_m = sight_lines_.lowest_z_m[static_cast<std::size_t>(number)];
  cell.no_return = points.empty() && sight_lines_.no_return(number);
  if (points.empty()) return;
  const CellNoise noise{width_px(cell.cell, points.front().z_m, evidence_.lattice, view), alike_px};
  const auto significance = static_cast<float>(settings_.cells.significance_sigmas);
  const float rise_m =
      deciders_[i].surfel < 0 ? 0.0F : significant_rise(rises_, window, number, significance, noise);
  summarize_cell(points, deciders_[i], rise_m, scratch, cell);
}

void FloorPerception::find_seen_cells(const CellWindow& window) {
  seen_cells_.clear();
  for (std::int32_t number = 0; number < window.count(); ++number)
    if (!cell_points_.of(number).empty() || sight_lines_.passed(number) || sight_lines_.no_return(number))
      seen_cells_.push_back(number);
}

void FloorPerception::remember(const SensorView& view) {
  evidence_.sections.clear();
  const double min_upright = std::cos(settings_.planes.max_floor_tilt_deg * std::numbers::pi / 180.0);
  for (int section = 0; section < grid_.count(); ++section) {
    const SectionResult& result = results_[static_cast<std::size_t>(section)];
    SectionMemory& memory = memory_[static_cast<std::size_t>(section)];
    memory.age =
        result.done ? std::int16_t{0} : static_cast<std::int16_t>(std::min(memory.age + 1, INT16_MAX));
    if (!result.planes.empty() && result.planes.front().dominant) {
      const Eigen::Vector3d normal =
          view.T_world_sensor.linear() * result.planes.front().plane.normal().cast<double>();
      if (normal.z() >= min_upright) memory.floor_normal = normal.normalized();
    }
    evidence_.sections.push_back({static_cast<std::int16_t>(section / grid_.y_res()),
                                  static_cast<std::int16_t>(section % grid_.y_res()), result.done, memory.age,
                                  cloud_.section_size(section)});
  }
}

}  // namespace floornav
