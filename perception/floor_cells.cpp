#include "perception/floor_cells.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "perception/side_end.hpp"
#include "perception/top_edge.hpp"
#include "perception/uprightness.hpp"
#include "runtime/geometry/step_limit.hpp"

namespace floornav {

namespace {

constexpr int kCellsPerPiece = 256;
constexpr double kLeastDepth_m = 0.1;

/// How wide a cell is in the image, as seen at a height.
float width_px(CellIndex cell, float z_m, const Lattice& lattice, const SensorView& view) {
  const Eigen::Vector3d middle(lattice.center_of(cell.ix), lattice.center_of(cell.iy),
                               static_cast<double>(z_m));
  const double depth_m = view.T_world_sensor.linear().col(2).dot(middle - view.T_world_sensor.translation());
  return view.camera.fx * static_cast<float>(lattice.pitch_m / std::max(depth_m, kLeastDepth_m));
}

/// Of a plane that has a height of its own at a place: that of the cell's middle, wherever its points lie.
void take_middle(const FloorEvidence& evidence, float rise_m, CellEvidence& cell) {
  const Surfel& plane = evidence.surfels[static_cast<std::size_t>(cell.surfel)];
  if (plane.normal.z() <= kLevelUpright) return;
  const Eigen::Vector2d way(evidence.lattice.center_of(cell.cell.ix) - plane.centroid_m.x(),
                            evidence.lattice.center_of(cell.cell.iy) - plane.centroid_m.y());
  const double up_m = -plane.normal.head<2>().cast<double>().dot(way) / static_cast<double>(plane.normal.z());
  cell.mean_z_m = static_cast<float>(plane.centroid_m.z() + up_m) + rise_m;
}

}  // namespace

FloorCells::FloorCells(const PerceptionSettings& settings, const RobotSettings& robot,
                       const SectionGrid& grid)
    : roi_(settings.roi),
      settings_(settings.cells),
      grid_(grid),
      max_step_m_(static_cast<float>(step_limit_m(robot))),
      sorter_(settings.roi),
      tracer_(settings.roi, settings.cells),
      missing_floor_finder_(settings.roi, grid),
      outline_finder_(step_limit_m(robot)),
      crossing_sides_(step_limit_m(robot)) {}

void FloorCells::begin(const MeasuredImage& image, const RoiCloud& cloud, const SensorView& view,
                       Parallel& parallel) {
  scratch_.resize(static_cast<std::size_t>(parallel.workers()));
  sorter_.begin(cloud);
  window_ = CellWindow({.pitch_m = settings_.pitch_m}, roi_, view.T_world_body);
  cell_sections_.find(window_, grid_, view.T_world_body);
  noise_.clear();
  missing_floor_.assign(cell_sections_.size(), 0);
  rises_.assign(cell_sections_.size(), {});
  crossing_sides_.begin(window_.count());
  tracer_.trace(image, view, window_, parallel, lowest_ray_z_m_);
  outline_finder_.find(image, view, window_, parallel, outlines_);
}

void FloorCells::add(int first, int end, const MeasuredImage& image, const RoiCloud& cloud,
                     const SensorView& view, std::span<const SectionResult> sections,
                     std::span<const std::int16_t> label, Parallel& parallel, FloorEvidence& evidence) {
  const bool is_near = first == 0;
  const auto known = sections.first(static_cast<std::size_t>(end));
  sorter_.place(cloud, label, known, first, end, view, window_, parallel);
  sorter_.sort(cloud, label, known, end, cell_sections_, is_near, parallel, points_);
  const auto is_asked = [&](std::int32_t cell) { return cell_sections_.is_near(cell) == is_near; };
  missing_floor_finder_.find(image, view, known, window_, cell_sections_, points_, std::ref(is_asked),
                             parallel, missing_floor_);
  find_seen(is_near, known);
  noise_.measure(first, end, cloud, label, known, parallel);
  summarize(image, view, noise_.alike_px(), parallel, evidence);
}

void FloorCells::find_seen(bool is_near, std::span<const SectionResult> sections) {
  seen_.clear();
  for (std::int32_t number = 0; number < window_.count(); ++number) {
    if (cell_sections_.is_near(number) != is_near) continue;
    const auto n = static_cast<std::size_t>(number);
    const int section = cell_sections_.of(number);
    const bool is_done = section >= 0 && sections[static_cast<std::size_t>(section)].done;
    if (!is_done) lowest_ray_z_m_[n] = std::numeric_limits<float>::infinity();
    const bool was_passed = lowest_ray_z_m_[n] < std::numeric_limits<float>::infinity();
    if (!points_.of(number).empty() || was_passed || missing_floor_[n] != 0) seen_.push_back(number);
  }
}

/// Adds the cells that were seen to the evidence.
void FloorCells::summarize(const MeasuredImage& image, const SensorView& view, float alike_px,
                           Parallel& parallel, FloorEvidence& evidence) {
  const std::size_t first = evidence.cells.size();
  evidence.cells.resize(first + seen_.size());
  deciders_.resize(seen_.size());
  const std::size_t pieces = (seen_.size() + kCellsPerPiece - 1) / kCellsPerPiece;
  const auto each_of = [&](int piece, auto treat) {
    const std::size_t begin = static_cast<std::size_t>(piece) * kCellsPerPiece;
    for (std::size_t i = begin; i < std::min(seen_.size(), begin + kCellsPerPiece); ++i) treat(i);
  };
  const auto decide_piece = [&](int piece, int worker) {
    each_of(piece,
            [&](std::size_t i) { decide(i, evidence.surfels, scratch_[static_cast<std::size_t>(worker)]); });
  };
  parallel.run(static_cast<int>(pieces), std::ref(decide_piece));
  const auto summarize_piece = [&](int piece, int worker) {
    each_of(piece, [&](std::size_t i) {
      CellScratch& scratch = scratch_[static_cast<std::size_t>(worker)];
      CellEvidence& cell = evidence.cells[first + i];
      summarize_one(i, view, alike_px, evidence, scratch, cell);
      if (cell.surfel >= 0) end_side(deciders_[i], image, view, evidence, scratch, cell);
    });
  };
  parallel.run(static_cast<int>(pieces), std::ref(summarize_piece));
}

/// Finds what decides a seen cell, and how far its points are above it.
void FloorCells::decide(std::size_t seen, std::span<const Surfel> surfels, CellScratch& scratch) {
  const auto points = points_.of(seen_[seen]);
  DecidingSurfel& decider = deciders_[seen];
  decider = points.empty() ? DecidingSurfel{} : find_deciding_surfel(points, surfels.size(), scratch);
  const bool is_decided = decider.surfel >= 0;
  const float upright = is_decided ? surfels[static_cast<std::size_t>(decider.surfel)].normal.z() : 0.0F;
  // Mostly all points are on level ground, and there is no side to note.
  const bool has_others = static_cast<std::size_t>(decider.rise.points) < points.size();
  if (upright <= kSideUpright || has_others) crossing_sides_.note(seen_[seen], points, surfels);
  if (!is_decided) return;
  const bool floor = surfels[static_cast<std::size_t>(decider.surfel)].dominant;
  decider.slanted = upright > kSideUpright && upright <= kLevelUpright;
  decider.rise.group = floor ? CellRise::kFloor : decider.surfel;
  rises_[static_cast<std::size_t>(seen_[seen])] = decider.rise;
}

void FloorCells::summarize_one(std::size_t seen, const SensorView& view, float alike_px,
                               const FloorEvidence& evidence, CellScratch& scratch,
                               CellEvidence& cell) const {
  const std::int32_t number = seen_[seen];
  const auto n = static_cast<std::size_t>(number);
  const auto points = points_.of(number);
  cell.cell = window_.cell(number);
  if (lowest_ray_z_m_[n] < std::numeric_limits<float>::infinity()) cell.ray_z_m = lowest_ray_z_m_[n];
  cell.no_return = missing_floor_[n] != 0;
  if (points.empty()) return;
  cell.partly_hidden = outlines_.hidden[n] != 0;
  const CellNoise noise{width_px(cell.cell, points.front().z_m, evidence.lattice, view), alike_px};
  const auto significance = static_cast<float>(settings_.significance_sigmas);
  const float rise_m =
      deciders_[seen].surfel < 0 ? 0.0F : significant_rise(rises_, window_, number, significance, noise);
  summarize_cell(points, deciders_[seen], rise_m, scratch, cell);
  if (cell.surfel >= 0) take_middle(evidence, rise_m, cell);
  cell.on_edge = is_on_edge(number, cell, evidence.surfels);
}

/// A ledge counts that is one of the cell's plane, not of what is above or below it.
bool FloorCells::is_on_edge(std::int32_t number, const CellEvidence& cell,
                            std::span<const Surfel> surfels) const {
  if (cell.surfel < 0 || surfels[static_cast<std::size_t>(cell.surfel)].normal.z() <= kLevelUpright)
    return false;
  const float above_m = outlines_.ledge_z_m[static_cast<std::size_t>(number)] - cell.mean_z_m;
  return std::abs(above_m) < 2.0F * max_step_m_ ||
         crossing_sides_.cross(number, cell.mean_z_m, window_, surfels);
}

/// Lets the points of a thing's top that pass for points of its side not make the side higher.
void FloorCells::end_side(const DecidingSurfel& decider, const MeasuredImage& image, const SensorView& view,
                          const FloorEvidence& evidence, CellScratch& scratch, CellEvidence& cell) const {
  constexpr float kRoom_m = 0.01F;
  const Surfel& side = evidence.surfels[static_cast<std::size_t>(cell.surfel)];
  if (side.dominant) return;
  std::optional<float> top_z_m = edge_with_top_z_m(cell.top_z_m, decider.thrown_m(), cell, view, evidence);
  if (!top_z_m && side.normal.z() <= kSideUpright) {
    const Lattice& lattice = evidence.lattice;
    const Eigen::Vector2d middle(lattice.center_of(cell.cell.ix), lattice.center_of(cell.cell.iy));
    top_z_m = side_end_z_m(side, {middle, lattice.pitch_m, cell.top_z_m, decider.thrown_m() + kRoom_m}, image,
                           view, scratch.end_pixels);
  }
  cell.top_z_m = top_z_m.value_or(cell.top_z_m);
  if (side.normal.z() <= kSideUpright) cell.mean_z_m = std::min(cell.mean_z_m, cell.top_z_m);
}

}  // namespace floornav
