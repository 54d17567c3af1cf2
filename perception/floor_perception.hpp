#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "perception/cell_evidence.hpp"
#include "perception/cell_points.hpp"
#include "perception/cell_sections.hpp"
#include "perception/compromise.hpp"
#include "perception/depth_frame.hpp"
#include "perception/evidence.hpp"
#include "perception/floor_agreement.hpp"
#include "perception/missing_floor.hpp"
#include "perception/outliers.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_order.hpp"
#include "perception/section_planes.hpp"
#include "perception/sections.hpp"
#include "perception/settings.hpp"
#include "perception/sight_lines.hpp"
#include "perception/thinned_frame.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Asked before the nearest row, which is done whatever the answer, and before each other section in the
/// order of SectionOrder, with an estimate of its work that is the same on every machine. False: the section
/// is skipped and carries no evidence.
using Admission = std::function<bool(std::int64_t work_ns)>;

/// What a frame goes through: outliers, planes and cells first for the nearest row of sections, then for the
/// others.
enum class PerceptionStage { kRoi, kOutliers, kPlanes, kCells };

/// Told when a stage has ended, by whoever measures.
using StageEnd = std::function<void(PerceptionStage)>;

/// Told when all of the nearest row's evidence is there: its surfels, and the cells that lie in it whole.
/// What is added later comes behind it.
using NearRowEnd = std::function<void(const FloorEvidence&)>;

/// Finds the floor and whatever else is plane in depth frames of one sensor (sections 3 and 4 of the paper).
/// Keeps nothing of the world but each section's last known floor normal, which cuts the next frame's search.
/// The same frames give the same evidence, bit for bit, with any number of workers.
class FloorPerception {
 public:
  static constexpr std::int16_t kMaxAge = SectionOrder::kMaxAge;

  /// Throws std::invalid_argument where the ROI is empty.
  FloorPerception(const PerceptionSettings& settings, const RobotSettings& robot);

  /// Where the robot is going: sections on the path have their turn early.
  void set_path(std::span<const Eigen::Vector2d> path) { order_.set_path(path); }
  /// What the next frames give up to be in time.
  void set_compromise(const Compromise& compromise);

  /// `T_world_body` is the body's pose in the local world frame at the frame's time.
  /// The result lasts until the next call. After a few frames of a kind nothing is allocated any more.
  const FloorEvidence& process(
      const DepthFrame& frame, const Pose& T_world_body, Parallel& parallel, const Admission& admit,
      const StageEnd& end_stage = [](PerceptionStage) {},
      const NearRowEnd& end_near_row = [](const FloorEvidence&) {});

 private:
  struct SectionMemory {
    Eigen::Vector3d floor_normal = Eigen::Vector3d::UnitZ();  ///< last known, local world frame
    std::int16_t age = 0;                                     ///< frames since it was last done
  };
  /// Scratch memory of one worker.
  struct Worker {
    OutlierRemover outliers;
    SectionScratch sections;
    CellScratch cells;
  };

  void begin(const DepthFrame& frame, const SensorView& view, Parallel& parallel);
  [[nodiscard]] std::int64_t work_of(int section) const;
  void search_near_row(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                       const Admission& admit, const StageEnd& end_stage);
  void search_others(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                     const Admission& admit, const StageEnd& end_stage);
  void search_turn(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                   const StageEnd& end_stage);
  void remove_turn_outliers(const Pinhole& camera, Parallel& parallel);
  void remove_section_outliers(int section, const Pinhole& camera, OutlierRemover& remover,
                               Parallel& parallel);
  void find_section_planes(int section, std::int64_t utime_us, const SensorView& view,
                           SectionScratch& scratch);
  void collect(int first_section, int end_section, const SensorView& view, Parallel& parallel);
  void agree_on_floor(int first_section, int end_section);
  void collect_surfels(int first_section, int end_section, const SensorView& view, Parallel& parallel);
  void collect_cells(int first_section, int end_section, const SensorView& view, Parallel& parallel);
  void find_seen_cells(bool is_near);
  void summarize_cells(int end_section, const SensorView& view, Parallel& parallel);
  void decide_cell(std::size_t seen, CellScratch& scratch);
  void summarize_seen_cell(std::size_t seen, const SensorView& view, float alike_px, CellScratch& scratch,
                           CellEvidence& cell) const;
  void remember(const SensorView& view);
  void report_sections(bool near_row_only);

  PerceptionSettings settings_;
  RobotSettings robot_;
  Compromise compromise_;
  SectionGrid grid_;
  SectionOrder order_;
  ThinnedFrame thinned_;
  RoiClipper clipper_;
  SectionPlaneFinder plane_finder_;
  CellSorter cell_sorter_;
  SightLineTracer tracer_;
  MissingFloorFinder missing_floor_finder_;
  std::vector<SectionMemory> memory_;

  // Of the frame in hand; kept so that a frame allocates nothing.
  FloorEvidence evidence_;
  std::vector<std::int16_t> ages_;  ///< a section
  std::vector<int> turn_;           ///< sections that are searched together
  RoiCloud cloud_;
  std::vector<std::uint8_t> keep_;
  std::vector<std::int16_t> label_;
  std::vector<SectionResult> results_;
  FloorAgreement floor_agreement_;
  CellWindow window_;
  CellSections cell_sections_;
  CellPoints cell_points_;
  std::vector<float> lowest_ray_z_m_;        ///< a cell
  std::vector<std::uint8_t> missing_floor_;  ///< a cell
  std::vector<std::int32_t> seen_cells_;
  std::vector<DecidingSurfel> deciders_;  ///< a seen cell
  std::vector<CellRise> rises_;           ///< a cell of the window
  std::vector<Worker> workers_;
};

}  // namespace floornav
