#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "perception/lower_border.hpp"
#include "perception/pixel_blocks.hpp"
#include "perception/plane_pool.hpp"
#include "perception/plane_splitter.hpp"
#include "perception/pool_kernel.hpp"
#include "perception/ransac.hpp"
#include "perception/reach.hpp"
#include "perception/roi_cloud.hpp"
#include "perception/sensor_view.hpp"
#include "perception/settings.hpp"

namespace floornav {

/// Labels of points that are on no plane.
inline constexpr std::int16_t kNoPlane = -1;     ///< seen, belongs to no plane
inline constexpr std::int16_t kPlaneNoise = -2;  ///< just off a plane that owns its surroundings
inline constexpr std::int16_t kOutlier = -3;     ///< removed by eq. (6)

struct SectionPlane {
  InverseDepthPlane plane;
  PlaneFit fit;           ///< of the points that gave the plane
  bool dominant = false;  ///< the section's floor: first pass
};

/// Scratch memory of one worker.
struct SectionScratch {
  PlanePool pool;
  PlanePool floor_pool;
  RansacScratch ransac;
  PixelBlocks blocks;
  PlaneSplitter splitter;
  LowerBorder lower_border;
  // Of each point of the pool, and of the plane in hand:
  std::vector<float> distance;  ///< off the plane, in sigmas
  std::vector<Claim> claims;
  std::vector<float> weights;  ///< 1 for the plane's points
};

/// Recursive RANSAC of one section (section 4.6.1).
class SectionPlaneFinder {
 public:
  SectionPlaneFinder(const PlaneSettings& settings, const RobotSettings& robot);

  /// Fills in the section's planes: first the floor, near `floor_normal_world` (its last known normal) and
  /// where the robot can come to; then planes of any inclination among the points left over, until too few
  /// are left or the recursion's limit. `label` (of the whole cloud; kOutlier where a point is removed
  /// already) gets each point's index into `planes`.
  void find(const RoiCloud& cloud, int section, const SensorView& view,
            const Eigen::Vector3d& floor_normal_world, std::uint64_t seed, std::span<std::int16_t> label,
            Parallel& parallel, SectionScratch& scratch, std::vector<SectionPlane>& planes) const;

 private:
  struct Search;

  PlaneSettings settings_;
  Reach reach_;
};

}  // namespace floornav
