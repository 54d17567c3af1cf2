#include "perception/floor_perception.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "perception/noise_correlation.hpp"
#include "perception/surfels.hpp"
#include "perception/top_edge.hpp"

namespace floornav {

namespace {

constexpr int kCellsPerPiece = 512;
constexpr double kLeastDepth_m = 0.1;
/// Larger sections are worked on by all workers together.
constexpr std::int32_t kPointsOfOneWorker = 16384;

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
      order_(grid_),
      clipper_(settings.roi, grid_),
      plane_finder_(settings.planes, robot),
      cell_sorter_(settings.roi),
      tracer_(settings.roi, settings.cells),
      missing_floor_finder_(settings.roi, grid_),
      memory_(static_cast<std::size_t>(grid_.count())) {}

void FloorPerception::set_compromise(const Compromise& compromise) {
  compromise_ = compromise;
  plane_finder_ = SectionPlaneFinder(compromise.applied_to(settings_.planes), robot_);
}

const FloorEvidence& FloorPerception::process(const DepthFrame& whole_frame, const Pose& T_world_body,
                                              Parallel& parallel, const Admission& admit,
                                              const StageEnd& end_stage, const NearRowEnd& end_near_row) {
  const DepthFrame frame = thinned_.thin(whole_frame, compromise_.point_stride);
  const SensorView view(frame, T_world_body);
  begin(frame, view, parallel);
  end_stage(PerceptionStage::kRoi);
  tracer_.trace(clipper_.image(), view, window_, parallel, lowest_ray_z_m_);
  end_stage(PerceptionStage::kCells);
  search_near_row(frame, view, parallel, admit, end_stage);
  end_near_row(evidence_);
  search_others(frame, view, parallel, admit, end_stage);
  remember(view);
  return evidence_;
}

/// Makes the frame's points; empties what the frame before has left.
void FloorPerception::begin(const DepthFrame& frame, const SensorView& view, Parallel& parallel) {
  workers_.resize(static_cast<std::size_t>(parallel.workers()),
                  Worker{OutlierRemover(settings_.outliers), {}, {}});
  evidence_.utime_us = frame.utime_us;
  evidence_.T_world_body = view.T_world_body;
  evidence_.T_body_sensor = frame.T_body_sensor;
  evidence_.lattice.pitch_m = settings_.cells.pitch_m;
  evidence_.compromise = compromise_;
  evidence_.surfels.clear();
  evidence_.cells.clear();
  evidence_.pixels = clipper_.clip(frame, view, parallel, cloud_);
  results_.resize(static_cast<std::size_t>(grid_.count()));
  for (SectionResult& result : results_) {
    result.done = false;
    result.outliers = 0;
    result.planes.clear();
    result.surfels.clear();
  }
  keep_.resize(cloud_.size());
  label_.assign(cloud_.size(), kOutlier);
  floor_agreement_.clear();
  cell_sorter_.begin(cloud_);
  window_ = CellWindow(evidence_.lattice, settings_.roi, view.T_world_body);
  cell_sections_.find(window_, grid_, view.T_world_body);
  missing_floor_.assign(cell_sections_.size(), 0);
  rises_.assign(cell_sections_.size(), {});
}

/// From the points to the cells.
std::int64_t FloorPerception::work_of(int section) const {
  const int density = compromise_.point_stride * compromise_.point_stride;
  return static_cast<std::int64_t>(compromise_.work_per_point_ns() * density) * cloud_.section_size(section);
}

void FloorPerception::search_near_row(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                                      const Admission& admit, const StageEnd& end_stage) {
  turn_.clear();
  auto work_ns = static_cast<std::int64_t>(kWorkPerPixel_ns * static_cast<double>(frame.pixels.size()));
  for (int section = 0; section < grid_.y_res(); ++section) {
    turn_.push_back(section);
    work_ns += work_of(section);
  }
  admit(work_ns);
  search_turn(frame, view, parallel, end_stage);
  collect(0, grid_.y_res(), view, parallel);
  report_sections(true);
  end_stage(PerceptionStage::kCells);
}

/// A row's worth of sections at a time, so that the time that is left is asked for again and again.
void FloorPerception::search_others(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                                    const Admission& admit, const StageEnd& end_stage) {
  ages_.clear();
  for (const SectionMemory& memory : memory_) ages_.push_back(memory.age);
  const auto order = order_.order(ages_, view.T_world_body);
  const auto at_once = static_cast<std::size_t>(grid_.y_res());
  for (std::size_t first = 0; first < order.size(); first += at_once) {
    turn_.clear();
    for (const int section : order.subspan(first, std::min(at_once, order.size() - first)))
      if (admit(work_of(section))) turn_.push_back(section);
    search_turn(frame, view, parallel, end_stage);
  }
  collect(grid_.y_res(), grid_.count(), view, parallel);
  for (const SectionResult& result : results_) evidence_.pixels.outliers += result.outliers;
  end_stage(PerceptionStage::kCells);
}

/// Outliers and planes of the sections of the turn, the largest section first, so that the workers end
/// together.
void FloorPerception::search_turn(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                                  const StageEnd& end_stage) {
  std::sort(turn_.begin(), turn_.end(), [this](int a, int b) {
    const std::int32_t size_a = cloud_.section_size(a), size_b = cloud_.section_size(b);
    return size_a != size_b ? size_a > size_b : a < b;
  });
  for (const int section : turn_) results_[static_cast<std::size_t>(section)].done = true;
  remove_turn_outliers(frame.camera, parallel);
  end_stage(PerceptionStage::kOutliers);
  const auto find = [&](int index, int worker) {
    find_section_planes(turn_[static_cast<std::size_t>(index)], frame.utime_us, view,
                        workers_[static_cast<std::size_t>(worker)].sections);
  };
  parallel.run(static_cast<int>(turn_.size()), std::ref(find));
  end_stage(PerceptionStage::kPlanes);
}

void FloorPerception::remove_turn_outliers(const Pinhole& camera, Parallel& parallel) {
  std::size_t large = 0;
  for (; large < turn_.size() && cloud_.section_size(turn_[large]) > kPointsOfOneWorker; ++large)
    remove_section_outliers(turn_[large], camera, workers_.front().outliers, parallel);
  const auto remove = [&](int index, int worker) {
    Serial alone;
    remove_section_outliers(turn_[large + static_cast<std::size_t>(index)], camera,
                            workers_[static_cast<std::size_t>(worker)].outliers, alone);
  };
  parallel.run(static_cast<int>(turn_.size() - large), std::ref(remove));
}

void FloorPerception::remove_section_outliers(int section, const Pinhole& camera, OutlierRemover& remover,
                                              Parallel& parallel) {
  const auto begin = static_cast<std::size_t>(cloud_.section_begin(section));
  const auto size = static_cast<std::size_t>(cloud_.section_size(section));
  const auto part = [&](const auto& values) { return std::span(values).subspan(begin, size); };
  const std::span<std::uint8_t> keep = std::span(keep_).subspan(begin, size);
  const ImagePoints points{
      {part(cloud_.x), part(cloud_.y), part(cloud_.z)}, part(cloud_.pixel), camera, true};
  results_[static_cast<std::size_t>(section)].outliers = remover.remove(points, parallel, keep);
  for (std::size_t i = 0; i < size; ++i) label_[begin + i] = keep[i] ? kNoPlane : kOutlier;
}

void FloorPerception::find_section_planes(int section, std::int64_t utime_us, const SensorView& view,
                                          SectionScratch& scratch) {
  Random seed(static_cast<std::uint64_t>(settings_.planes.seed) ^
              (static_cast<std::uint64_t>(section) << 48) ^ static_cast<std::uint64_t>(utime_us));
  const auto s = static_cast<std::size_t>(section);
  plane_finder_.find(cloud_, section, view, memory_[s].floor_normal, seed.next(), label_, scratch,
                     results_[s].planes);
}

/// Makes evidence of the sections [first, end), of which the planes are found.
void FloorPerception::collect(int first_section, int end_section, const SensorView& view,
                              Parallel& parallel) {
  agree_on_floor(first_section, end_section);
  collect_surfels(first_section, end_section, view, parallel);
  collect_cells(first_section, end_section, view, parallel);
}

/// The sections' floors agree with each other and with those that were found before.
void FloorPerception::agree_on_floor(int first_section, int end_section) {
  const auto floor_of = [&](int section) -> SectionPlane* {
    auto& planes = results_[static_cast<std::size_t>(section)].planes;
    return !planes.empty() && planes.front().dominant ? &planes.front() : nullptr;
  };
  for (int section = first_section; section < end_section; ++section)
    if (const SectionPlane* floor = floor_of(section)) floor_agreement_.add(floor->fit);
  for (int section = first_section; section < end_section; ++section)
    if (SectionPlane* floor = floor_of(section))
      floor->plane = floor_agreement_.settle(floor->fit, floor->plane);
}

void FloorPerception::collect_surfels(int first_section, int end_section, const SensorView& view,
                                      Parallel& parallel) {
  const auto make = [&](int index, int worker) {
    SectionResult& result = results_[static_cast<std::size_t>(first_section + index)];
    make_surfels(cloud_, first_section + index, result.planes, label_, view, robot_,
                 workers_[static_cast<std::size_t>(worker)].cells.sums, result.surfels);
  };
  parallel.run(end_section - first_section, std::ref(make));
  for (int section = first_section; section < end_section; ++section) {
    SectionResult& result = results_[static_cast<std::size_t>(section)];
    result.first_surfel = static_cast<std::int16_t>(evidence_.surfels.size());
    evidence_.surfels.insert(evidence_.surfels.end(), result.surfels.begin(), result.surfels.end());
  }
}

/// The nearest row's sections bring the cells that lie in it whole, the others all the rest.
void FloorPerception::collect_cells(int first_section, int end_section, const SensorView& view,
                                    Parallel& parallel) {
  const bool is_near = first_section == 0;
  cell_sorter_.place(cloud_, label_, results_, first_section, end_section, view, window_, parallel);
  cell_sorter_.sort(cloud_, label_, results_, end_section, cell_sections_, is_near, parallel, cell_points_);
  const auto is_asked = [&](std::int32_t cell) { return cell_sections_.is_near(cell) == is_near; };
  missing_floor_finder_.find(clipper_.image(), view, results_, window_, cell_sections_, cell_points_,
                             std::ref(is_asked), parallel, missing_floor_);
  find_seen_cells(is_near);
  summarize_cells(end_section, view, parallel);
}

void FloorPerception::find_seen_cells(bool is_near) {
  seen_cells_.clear();
  for (std::int32_t number = 0; number < window_.count(); ++number) {
    if (cell_sections_.is_near(number) != is_near) continue;
    const auto n = static_cast<std::size_t>(number);
    const int section = cell_sections_.of(number);
    const bool is_done = section >= 0 && results_[static_cast<std::size_t>(section)].done;
    if (!is_done) lowest_ray_z_m_[n] = std::numeric_limits<float>::infinity();
    const bool was_passed = lowest_ray_z_m_[n] < std::numeric_limits<float>::infinity();
    if (!cell_points_.of(number).empty() || was_passed || missing_floor_[n] != 0)
      seen_cells_.push_back(number);
  }
}

/// Adds the cells that were seen to the evidence. `end_section`: planes are known up to there.
void FloorPerception::summarize_cells(int end_section, const SensorView& view, Parallel& parallel) {
  const std::size_t first = evidence_.cells.size();
  evidence_.cells.resize(first + seen_cells_.size());
  deciders_.resize(seen_cells_.size());
  const float alike_px =
      alike_length_px(cloud_, label_, std::span(results_).first(static_cast<std::size_t>(end_section)));
  const int count = static_cast<int>(seen_cells_.size());
  const auto decide = [&](int piece, int worker) {
    for (int i = piece * kCellsPerPiece; i < std::min(count, (piece + 1) * kCellsPerPiece); ++i)
      decide_cell(static_cast<std::size_t>(i), workers_[static_cast<std::size_t>(worker)].cells);
  };
  const int pieces = (count + kCellsPerPiece - 1) / kCellsPerPiece;
  parallel.run(pieces, std::ref(decide));
  const auto summarize = [&](int piece, int worker) {
    for (int i = piece * kCellsPerPiece; i < std::min(count, (piece + 1) * kCellsPerPiece); ++i)
      summarize_seen_cell(static_cast<std::size_t>(i), view, alike_px,
                          workers_[static_cast<std::size_t>(worker)].cells,
                          evidence_.cells[first + static_cast<std::size_t>(i)]);
  };
  parallel.run(pieces, std::ref(summarize));
}

/// Finds what decides a seen cell, and how far its points are above it.
void FloorPerception::decide_cell(std::size_t seen, CellScratch& scratch) {
  const auto points = cell_points_.of(seen_cells_[seen]);
  DecidingSurfel& decider = deciders_[seen];
  decider =
      points.empty() ? DecidingSurfel{} : find_deciding_surfel(points, evidence_.surfels.size(), scratch);
  if (decider.surfel < 0) return;
  const bool floor = evidence_.surfels[static_cast<std::size_t>(decider.surfel)].dominant;
  decider.rise.group = floor ? CellRise::kFloor : decider.surfel;
  rises_[static_cast<std::size_t>(seen_cells_[seen])] = decider.rise;
}

void FloorPerception::summarize_seen_cell(std::size_t seen, const SensorView& view, float alike_px,
                                          CellScratch& scratch, CellEvidence& cell) const {
  const std::int32_t number = seen_cells_[seen];
  const auto n = static_cast<std::size_t>(number);
  const auto points = cell_points_.of(number);
  cell.cell = window_.cell(number);
  if (lowest_ray_z_m_[n] < std::numeric_limits<float>::infinity()) cell.ray_z_m = lowest_ray_z_m_[n];
  cell.no_return = missing_floor_[n] != 0;
  if (points.empty()) return;
  const CellNoise noise{width_px(cell.cell, points.front().z_m, evidence_.lattice, view), alike_px};
  const auto significance = static_cast<float>(settings_.cells.significance_sigmas);
  const float rise_m =
      deciders_[seen].surfel < 0 ? 0.0F : significant_rise(rises_, window_, number, significance, noise);
  summarize_cell(points, deciders_[seen], rise_m, scratch, cell);
  if (cell.surfel >= 0)
    cell.top_z_m = side_top_z_m(cell.top_z_m, deciders_[seen].thrown_m(), cell, view, evidence_);
}

/// Keeps the floors' normals for the next frame, and tells what became of the sections.
void FloorPerception::remember(const SensorView& view) {
  const double min_upright = std::cos(settings_.planes.max_floor_tilt_deg * std::numbers::pi / 180.0);
  for (std::size_t s = 0; s < memory_.size(); ++s) {
    const SectionResult& result = results_[s];
    SectionMemory& memory = memory_[s];
    memory.age =
        result.done ? std::int16_t{0} : static_cast<std::int16_t>(std::min(memory.age + 1, INT16_MAX));
    if (result.planes.empty() || !result.planes.front().dominant) continue;
    const Eigen::Vector3d normal =
        view.T_world_sensor.linear() * result.planes.front().plane.normal().cast<double>();
    if (normal.z() >= min_upright) memory.floor_normal = normal.normalized();
  }
  report_sections(false);
}

void FloorPerception::report_sections(bool near_row_only) {
  evidence_.sections.clear();
  for (int section = 0; section < grid_.count(); ++section) {
    const bool is_later = near_row_only && section >= grid_.y_res();
    const std::int16_t age =
        near_row_only && !is_later ? std::int16_t{0} : memory_[static_cast<std::size_t>(section)].age;
    evidence_.sections.push_back(
        {static_cast<std::int16_t>(grid_.row_of(section)), static_cast<std::int16_t>(section % grid_.y_res()),
         results_[static_cast<std::size_t>(section)].done, age, cloud_.section_size(section), is_later});
  }
}

}  // namespace floornav
