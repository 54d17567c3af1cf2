#include "perception/section_planes.hpp"

#include <cmath>
#include <numbers>

#include "perception/plane_kernel.hpp"

namespace floornav {

namespace {

/// Points that are off a plane by up to this many thresholds, where it holds most of the points, are its
/// noise.
constexpr float kNoiseBand = 1.5F;
constexpr float kReachSlack_m = 0.05F;
/// A plane is taken as parallel to the section's floor unless its points deny it: 0.1 % of the chi square
/// distribution with two degrees of freedom.
constexpr double kParallelCost = 13.8;

float radians(double degrees) {
  return static_cast<float>(degrees * std::numbers::pi / 180.0);
}

}  // namespace

/// One section's recursion.
struct SectionPlaneFinder::Search {
  const SectionPlaneFinder& finder;
  const RoiCloud& cloud;
  const SensorView& view;
  std::span<std::int16_t> label;
  SectionScratch& scratch;
  Random random;
  std::vector<SectionPlane>& planes;

  [[nodiscard]] float threshold() const { return static_cast<float>(finder.settings_.threshold_sigmas); }

  void fill_pool(int section) {
    PlanePool& pool = scratch.pool;
    pool.resize(static_cast<std::size_t>(cloud.section_size(section)));
    std::size_t end = 0;
    for (std::int32_t p = cloud.section_begin(section);
         p < cloud.section_end[static_cast<std::size_t>(section)]; ++p) {
      const auto i = static_cast<std::size_t>(p);
      if (label[i] == kOutlier) continue;
      label[i] = kNoPlane;
      pool.ray_x[end] = cloud.ray_x[i];
      pool.ray_y[end] = cloud.ray_y[i];
      pool.inverse_depth[end] = cloud.inverse_depth[i];
      pool.certainty[end] = cloud.certainty[i];
      pool.point[end] = p;
      pool.block[end] = cloud.block[i];
      ++end;
    }
    pool.resize(end);
    scratch.blocks.begin(view.camera, pool);
  }

  /// Points where floor can be that the robot can come to: desks and walls do not compete with the floor.
  void fill_floor_pool() {
    const Eigen::Matrix3f R = view.T_world_sensor.linear().cast<float>();
    const Eigen::Vector3f sensor =
        (view.T_world_sensor.translation() - view.T_world_body.translation()).cast<float>();
    const PlanePool& pool = scratch.pool;
    scratch.floor_pool.resize(pool.size());
    std::size_t end = 0;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      const Eigen::Vector3f ray = R * Eigen::Vector3f(pool.ray_x[i], pool.ray_y[i], 1.0F);
      const float depth = 1.0F / pool.inverse_depth[i];
      const Eigen::Vector3f p = sensor + depth * ray;
      const float sigma_height = depth * depth / pool.certainty[i] * std::abs(ray.z());
      if (finder.reach_.holds(p.head<2>().norm(), p.z(), kReachSlack_m + 3.0F * sigma_height))
        scratch.floor_pool.set(end++, pool, i);
    }
    scratch.floor_pool.resize(end);
  }

  [[nodiscard]] bool claims(const PlanePool& pool, std::size_t i, const InverseDepthPlane& plane) const {
    return std::abs(pool.residual(i, plane)) <= threshold() && scratch.blocks.owned(pool.block[i]);
  }

  /// Where the plane owns its points. The floor may lie in several patches, with obstacles between them; any
  /// other plane is one patch.
  void count_blocks(const PlanePool& pool, const InverseDepthPlane& plane, bool is_floor) {
    scratch.blocks.count(pool, plane, threshold());
    if (!is_floor) scratch.blocks.keep_largest_patch();
  }

  /// Refines on the points that the plane owns; nothing where they are too few.
  std::optional<SectionPlane> settle(const PlanePool& pool, const InverseDepthPlane& found, bool is_floor) {
    count_blocks(pool, found, is_floor);
    scratch.claimed.resize(pool.size());
    int points = 0;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      const bool claimed = claims(pool, i, found);
      scratch.claimed[i] = claimed ? 1.0F : 0.0F;
      points += claimed ? 1 : 0;
    }
    if (points < finder.settings_.min_points) return std::nullopt;
    const PlaneFit fit = fit_inliers(pool, found, threshold(), scratch.claimed);
    const auto free = fit.solve();
    if (!free) return std::nullopt;
    const SectionPlane settled{*free, fit, is_floor};
    if (is_floor || planes.empty() || !planes.front().dominant) return settled;
    const InverseDepthPlane parallel = fit.solve_parallel(planes.front().plane);
    return fit.cost(parallel) - fit.cost(*free) < kParallelCost ? SectionPlane{parallel, fit, false}
                                                                : settled;
  }

  /// Labels the plane's points and takes them, and the noise around them, out of the pool. False, and nothing
  /// is done, where they are too few.
  bool claim(const SectionPlane& settled) {
    const InverseDepthPlane& plane = settled.plane;
    PlanePool& pool = scratch.pool;
    count_blocks(pool, plane, settled.dominant);
    int points = 0;
    for (std::size_t i = 0; i < pool.size(); ++i) points += claims(pool, i, plane) ? 1 : 0;
    if (points < finder.settings_.min_points) return false;
    const auto index = static_cast<std::int16_t>(planes.size());
    pool.keep_if([&](std::size_t i) {
      const float distance = std::abs(pool.residual(i, plane));
      const bool claimed = claims(pool, i, plane);
      const bool noise = distance > threshold() && distance <= kNoiseBand * threshold() &&
                         scratch.blocks.mostly_owned(pool.block[i]);
      if (claimed || noise) label[static_cast<std::size_t>(pool.point[i])] = claimed ? index : kPlaneNoise;
      return !claimed && !noise;
    });
    planes.push_back(settled);
    return true;
  }

  /// Inliers of a plane that does not own enough of them stay without a plane.
  void set_aside(const InverseDepthPlane& plane) {
    PlanePool& pool = scratch.pool;
    pool.keep_if([&](std::size_t i) { return std::abs(pool.residual(i, plane)) > threshold(); });
  }

  /// First pass: the dominant floor plane.
  bool find_floor(const Eigen::Vector3d& normal_world) {
    PlaneQuery query;
    query.threshold_sigmas = threshold();
    query.max_hypotheses = finder.settings_.max_hypotheses;
    query.expected_normal = (view.T_world_sensor.linear().transpose() * normal_world).cast<float>();
    query.cos_tolerance = std::cos(radians(finder.settings_.normal_tolerance_deg));
    const auto found = find_plane(scratch.floor_pool, query, random, scratch.ransac);
    if (!found) return false;
    const auto settled = settle(scratch.floor_pool, *found, true);
    return settled && query.admits(settled->plane) && claim(*settled);
  }

  /// The passes after the first: planes of any inclination among the points left over.
  void find_others() {
    PlaneQuery query;
    query.threshold_sigmas = threshold();
    query.max_hypotheses = finder.settings_.max_hypotheses;
    if (!planes.empty()) query.expected_normal = planes.front().plane.normal();
    for (int pass = 0; pass < finder.settings_.max_planes; ++pass) {
      if (static_cast<int>(scratch.pool.size()) < finder.settings_.min_points) return;
      const auto found = find_plane(scratch.pool, query, random, scratch.ransac);
      if (!found) return;
      const auto settled = settle(scratch.pool, *found, false);
      if (!settled || !claim(*settled)) set_aside(*found);
    }
  }
};

SectionPlaneFinder::SectionPlaneFinder(const PlaneSettings& settings, const RobotSettings& robot)
    : settings_(settings), reach_(robot) {}

void SectionPlaneFinder::find(const RoiCloud& cloud, int section, const SensorView& view,
                              const Eigen::Vector3d& floor_normal_world, std::uint64_t seed,
                              std::span<std::int16_t> label, SectionScratch& scratch,
                              std::vector<SectionPlane>& planes) const {
  planes.clear();
  Search search{*this, cloud, view, label, scratch, Random(seed), planes};
  search.fill_pool(section);
  search.fill_floor_pool();
  if (!search.find_floor(floor_normal_world)) search.find_floor(Eigen::Vector3d::UnitZ());
  search.find_others();
}

}  // namespace floornav
