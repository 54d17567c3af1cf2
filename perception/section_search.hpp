#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "perception/floor_agreement.hpp"
#include "perception/outliers.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/section_planes.hpp"
#include "perception/section_result.hpp"
#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"
#include "perception/surfels.hpp"
#include "runtime/geometry/parallel.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// What a frame goes through. Sections pass through outliers and planes one by one, several at once where
/// there are several workers; the nearest row's cells come before the others'.
enum class PerceptionStage { kRoi, kOutliers, kPlanes, kCells };

/// Told when a stage has ended, by whoever measures; of single sections only where there is one worker.
using StageEnd = std::function<void(PerceptionStage)>;

/// From the points of a section to its surfels (sections 4.2 to 4.6). Keeps each section's last known floor
/// normal, which cuts the next frame's search.
class SectionSearch {
 public:
  SectionSearch(const PerceptionSettings& settings, const RobotSettings& robot, int sections);

  /// How planes are searched from the next frame on.
  void set_planes(const PlaneSettings& settings) { plane_finder_ = SectionPlaneFinder(settings, robot_); }

  /// Begins a frame: empties what the one before has left.
  void begin(const RoiCloud& cloud, std::int64_t utime_us, int workers);
  /// Removes a section's outliers and finds its planes; the work inside the section is shared as well.
  /// Different sections may be searched at the same time by different workers.
  void search(int section, const RoiCloud& cloud, const SensorView& view, int worker, Parallel& parallel,
              const StageEnd& end_stage);
  /// The floors of the sections [first, end) agree with each other and with those settled before; then all
  /// planes become surfels, which are added to `surfels`.
  void settle(int first, int end, const RoiCloud& cloud, const SensorView& view, Parallel& parallel,
              std::vector<Surfel>& surfels);
  /// Ends a frame: keeps the floors' normals for the next one.
  void remember(const SensorView& view);

  [[nodiscard]] std::span<const SectionResult> results() const { return results_; }
  /// Of each point: index of its plane in its section, or kNoPlane, kPlaneNoise, kOutlier.
  [[nodiscard]] std::span<const std::int16_t> label() const { return label_; }

 private:
  /// Scratch memory of one worker.
  struct Worker {
    OutlierRemover outliers;
    SectionScratch planes;
    std::vector<PlaneSums> sums;
  };

  void remove_outliers(int section, const RoiCloud& cloud, const SensorView& view, OutlierRemover& remover,
                       Parallel& parallel);
  void agree_on_floor(int first, int end);

  PerceptionSettings settings_;
  RobotSettings robot_;
  SectionPlaneFinder plane_finder_;
  std::vector<Eigen::Vector3d> floor_normal_;  ///< a section: last known, local world frame

  // Of the frame in hand; kept so that a frame allocates nothing.
  std::int64_t utime_us_ = 0;
  std::vector<std::uint8_t> keep_;
  std::vector<std::int16_t> label_;
  std::vector<SectionResult> results_;
  FloorAgreement floor_agreement_;
  std::vector<Worker> workers_;
};

}  // namespace floornav
