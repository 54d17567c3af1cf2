#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "perception/cell_evidence.hpp"
#include "perception/cell_points.hpp"
#include "perception/cell_sections.hpp"
#include "perception/crossing_sides.hpp"
#include "perception/evidence.hpp"
#include "perception/measured_image.hpp"
#include "perception/missing_floor.hpp"
#include "perception/noise_correlation.hpp"
#include "perception/outlines.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_result.hpp"
#include "perception/sections.hpp"
#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"
#include "perception/sight_lines.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Makes the cells of a frame's evidence: first those that lie in the nearest row of sections whole, then the
/// others.
class FloorCells {
 public:
  FloorCells(const PerceptionSettings& settings, const RobotSettings& robot, const SectionGrid& grid);

  /// Begins a frame: which cells there are, and which of them rays passed over.
  void begin(const MeasuredImage& image, const RoiCloud& cloud, const SensorView& view, Parallel& parallel);
  /// Adds the cells of the sections [first, end), which were searched and settled; `sections` and `label` are
  /// SectionSearch's, and what belongs to sections from `end` on is not looked at.
  void add(int first, int end, const MeasuredImage& image, const RoiCloud& cloud, const SensorView& view,
           std::span<const SectionResult> sections, std::span<const std::int16_t> label, Parallel& parallel,
           FloorEvidence& evidence);

 private:
  void find_seen(bool is_near, std::span<const SectionResult> sections);
  void summarize(const MeasuredImage& image, const SensorView& view, float alike_px, Parallel& parallel,
                 FloorEvidence& evidence);
  void decide(std::size_t seen, std::span<const Surfel> surfels, CellScratch& scratch);
  void summarize_one(std::size_t seen, const SensorView& view, float alike_px, const FloorEvidence& evidence,
                     CellScratch& scratch, CellEvidence& cell) const;
  [[nodiscard]] bool is_on_edge(std::int32_t number, const CellEvidence& cell,
                                std::span<const Surfel> surfels) const;
  void end_side(const DecidingSurfel& decider, const MeasuredImage& image, const SensorView& view,
                const FloorEvidence& evidence, CellScratch& scratch, CellEvidence& cell) const;

  RoiSettings roi_;
  CellSettings settings_;
  SectionGrid grid_;
  float max_step_m_;
  CellSorter sorter_;
  SightLineTracer tracer_;
  MissingFloorFinder missing_floor_finder_;
  OutlineFinder outline_finder_;
  CrossingSides crossing_sides_;

  // Of the frame in hand; kept so that a frame allocates nothing.
  CellWindow window_;
  CellSections cell_sections_;
  NoiseCorrelation noise_;
  CellPoints points_;
  std::vector<float> lowest_ray_z_m_;        ///< a cell
  std::vector<std::uint8_t> missing_floor_;  ///< a cell
  Outlines outlines_;
  std::vector<std::int32_t> seen_;
  std::vector<DecidingSurfel> deciders_;  ///< a seen cell
  std::vector<CellRise> rises_;           ///< a cell of the window
  std::vector<CellScratch> scratch_;      ///< a worker
};

}  // namespace floornav
