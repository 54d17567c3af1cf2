#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "perception/compromise.hpp"
#include "perception/depth_frame.hpp"
#include "perception/evidence.hpp"
#include "perception/floor_cells.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_order.hpp"
#include "perception/section_search.hpp"
#include "perception/sections.hpp"
#include "perception/settings.hpp"
#include "perception/thinned_frame.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Asked before the nearest row, which is done whatever the answer, and before each other section in the
/// order of SectionOrder, with an estimate of its work that is the same on every machine. False: the section
/// is skipped and carries no evidence.
using Admission = std::function<bool(std::int64_t work_ns)>;

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
  /// One frame on its way.
  struct Passage;

  void begin(const Passage& passage);
  void order_sections(const SensorView& view);
  void search(const Passage& passage);
  void fill_others(const Passage& passage);
  void finish_near_row(const Passage& passage);
  void collect(int first_section, int end_section, const Passage& passage);
  [[nodiscard]] std::int64_t work_of(int section) const;
  [[nodiscard]] std::int64_t work_of_near_row(const DepthFrame& frame) const;
  void count_ages();
  void report_sections(bool near_row_only);

  PerceptionSettings settings_;
  Compromise compromise_;
  SectionGrid grid_;
  SectionOrder order_;
  ThinnedFrame thinned_;
  RoiClipper clipper_;
  SectionSearch search_;
  FloorCells cells_;
  std::vector<std::int16_t> ages_;  ///< a section: frames since it was last done

  // Of the frame in hand; kept so that a frame allocates nothing.
  FloorEvidence evidence_;
  RoiCloud cloud_;
  std::vector<int> turns_;  ///< sections in the order in which they are searched
};

}  // namespace floornav
