#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "perception/cell_evidence.hpp"
#include "perception/cell_points.hpp"
#include "perception/depth_frame.hpp"
#include "perception/evidence.hpp"
#include "perception/floor_agreement.hpp"
#include "perception/outliers.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_planes.hpp"
#include "perception/sections.hpp"
#include "perception/settings.hpp"
#include "perception/sight_lines.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Asked before each section, nearest first, with an estimate of its work that is the same on every machine.
/// False: the section is skipped and carries no evidence. A row with a section that was skipped in kMaxAge
/// frames one after the other is asked before all rows but the nearest.
using Admission = std::function<bool(std::int64_t work_ns)>;

/// What a frame goes through: outliers and planes once for each row of sections.
enum class PerceptionStage { kRoi, kOutliers, kPlanes, kCells };

/// Told when a stage has ended, by whoever measures.
using StageEnd = std::function<void(PerceptionStage)>;

/// Finds the floor and whatever else is plane in depth frames of one sensor (sections 3 and 4 of the paper).
/// Keeps nothing of the world but each section's last known floor normal, which cuts the next frame's search.
/// The same frames give the same evidence, bit for bit, with any number of workers.
class FloorPerception {
 public:
  static constexpr std::int16_t kMaxAge = 10;  ///< frames

  /// Throws std::invalid_argument where the ROI is empty.
  FloorPerception(const PerceptionSettings& settings, const RobotSettings& robot);

  /// `T_world_body` is the body's pose in the local world frame at the frame's time.
  /// The result lasts until the next call. After a few frames of a kind nothing is allocated any more.
  const FloorEvidence& process(
      const DepthFrame& frame, const Pose& T_world_body, Parallel& parallel, const Admission& admit,
      const StageEnd& end_stage = [](PerceptionStage) {});

 private:
  struct SectionMemory {
    Eigen::Vector3d floor_normal = Eigen::Vector3d::UnitZ();  ///< last known, local world frame
    std::int16_t age = 0;                                     ///< frames since it was last done
  };

  void begin(const DepthFrame& frame, const SensorView& view, Parallel& parallel);
  void order_rows();
  void admit_row(int row, const Admission& admit);
  void remove_section_outliers(int section, const Pinhole& camera, Parallel& parallel);
  void find_section_planes(int section, std::int64_t utime_us, const SensorView& view,
                           SectionScratch& scratch);
  void find_row_planes(std::int64_t utime_us, const SensorView& view, Parallel& parallel);
  void agree_on_floor();
  void collect_surfels();
  void collect_cells(const SensorView& view, Parallel& parallel);
  void find_seen_cells(const CellWindow& window);
  void decide_cell(std::size_t i, CellScratch& scratch);
  void summarize_seen_cell(std::size_t i, const CellWindow& window, const SensorView& view, float alike_px,
                           CellScratch& scratch);
  void remember(const SensorView& view);

  PerceptionSettings settings_;
  RobotSettings robot_;
  SectionGrid grid_;
  Measurer measurer_;
  RoiClipper clipper_;
  OutlierRemover outlier_remover_;
  SectionPlaneFinder plane_finder_;
  CellSorter cell_sorter_;
  SightLineTracer tracer_;
  std::vector<SectionMemory> memory_;

  // Of the frame in hand; kept so that a frame allocates nothing.
  FloorEvidence evidence_;
  std::vector<int> rows_;          ///< of sections, in the order of their turn
  std::vector<int> row_sections_;  ///< admitted ones of the row in hand
  RoiCloud cloud_;
  std::vector<std::uint8_t> keep_;
  std::vector<std::int16_t> label_;
  std::vector<SectionResult> results_;
  FloorAgreement floor_agreement_;
  std::vector<SectionScratch> section_scratch_;
  CellPoints cell_points_;
  SightLines sight_lines_;
  std::vector<std::int32_t> seen_cells_;
  std::vector<DecidingSurfel> deciders_;  ///< a seen cell
  std::vector<CellRise> rises_;           ///< a cell of the window
  std::vector<CellScratch> cell_scratch_;
};

}  // namespace floornav
