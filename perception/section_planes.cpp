#include "perception/section_planes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floornav {

namespace {

constexpr int kBlock_px = 8;
/// A plane owns the points near it only in blocks of pixels where it holds at least this share: two planes'
/// line of intersection, or the far tail of the noise around a plane, is no plane of its own.
constexpr float kMinBlockShare = 0.3F;
/// Where it holds this share, points somewhat beyond the threshold are its noise.
constexpr float kOwnedBlockShare = 0.5F;
constexpr float kNoiseBand = 1.5F;  ///< times the threshold
constexpr float kReachSlack_m = 0.05F;

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
  int blocks_per_row = 0;

  [[nodiscard]] std::size_t block_of_point(std::int32_t point) const {
    const std::int32_t pixel = cloud.pixel[static_cast<std::size_t>(point)];
    const int row = pixel / view.camera.width;
    const int column = pixel % view.camera.width;
    return static_cast<std::size_t>(row / kBlock_px * blocks_per_row + column / kBlock_px);
  }

  void fill_pool(int section) {
    blocks_per_row = (view.camera.width + kBlock_px - 1) / kBlock_px;
    const int block_rows = (view.camera.height + kBlock_px - 1) / kBlock_px;
    scratch.block_points.assign(static_cast<std::size_t>(blocks_per_row * block_rows), 0);
    scratch.block_inliers.assign(scratch.block_points.size(), 0);
    scratch.pool.clear();
    for (std::int32_t p = cloud.section_begin(section);
         p < cloud.section_end[static_cast<std::size_t>(section)]; ++p) {
      const auto i = static_cast<std::size_t>(p);
      if (label[i] == kOutlier) continue;
      label[i] = kNoPlane;
      scratch.pool.add(cloud.ray_x[i], cloud.ray_y[i], cloud.inverse_depth[i], cloud.certainty[i], p);
      ++scratch.block_points[block_of_point(p)];
    }
  }

  /// Points where floor can be that the robot can come to: desks and walls do not compete with the floor.
  void fill_floor_pool() {
    scratch.floor_pool.clear();
    const Eigen::Matrix3f R = (view.T_world_body.linear() * view.T_body_sensor.linear()).cast<float>();
    const Eigen::Vector3f sensor =
        (view.T_world_sensor.translation() - view.T_world_body.translation()).cast<float>();
    const PlanePool& pool = scratch.pool;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      const Eigen::Vector3f ray = R * Eigen::Vector3f(pool.ray_x[i], pool.ray_y[i], 1.0F);
      const float depth = 1.0F / pool.inverse_depth[i];
      const Eigen::Vector3f p = sensor + depth * ray;
      const float sigma_height = depth * depth / pool.certainty[i] * std::abs(ray.z());
      if (!finder.reach_.holds(p.head<2>().norm(), p.z(), kReachSlack_m + 3.0F * sigma_height)) continue;
      scratch.floor_pool.add(pool.ray_x[i], pool.ray_y[i], pool.inverse_depth[i], pool.certainty[i],
                             pool.point[i]);
    }
  }

  void count_inliers(const PlanePool& pool, const InverseDepthPlane& plane) {
    std::fill(scratch.block_inliers.begin(), scratch.block_inliers.end(), 0);
    for (std::size_t i = 0; i < pool.size(); ++i)
      if (std::abs(pool.residual(i, plane)) <= threshold())
        ++scratch.block_inliers[block_of_point(pool.point[i])];
  }

  [[nodiscard]] float threshold() const { return static_cast<float>(finder.settings_.threshold_sigmas); }

  [[nodiscard]] float share_of_block(std::int32_t point) const {
    const std::size_t block = block_of_point(point);
    return static_cast<float>(scratch.block_inliers[block]) / static_cast<float>(scratch.block_points[block]);
  }

  [[nodiscard]] bool claims(const PlanePool& pool, std::size_t i, const InverseDepthPlane& plane) const {
    return std::abs(pool.residual(i, plane)) <= threshold() &&
           share_of_block(pool.point[i]) >= kMinBlockShare;
  }

  /// Refines on the points that the plane owns; nothing where they are too few.
  std::optional<InverseDepthPlane> settle(const PlanePool& pool, const InverseDepthPlane& found) {
    count_inliers(pool, found);
    PlaneFit fit;
    int points = 0;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      if (!claims(pool, i, found)) continue;
      fit.add(pool.ray_x[i], pool.ray_y[i], pool.inverse_depth[i], pool.certainty[i] * pool.certainty[i]);
      ++points;
    }
    return points < finder.settings_.min_points ? std::nullopt : fit.solve();
  }

  /// Labels the plane's points and takes them, and the noise around them, out of the pool.
  void claim(const InverseDepthPlane& plane, std::int16_t index) {
    PlanePool& pool = scratch.pool;
    count_inliers(pool, plane);
    pool.keep_if([&](std::size_t i) {
      const float distance = std::abs(pool.residual(i, plane));
      if (distance > kNoiseBand * threshold()) return true;
      const auto point = static_cast<std::size_t>(pool.point[i]);
      if (claims(pool, i, plane)) {
        label[point] = index;
        return false;
      }
      if (distance > threshold() && share_of_block(pool.point[i]) >= kOwnedBlockShare) {
        label[point] = kPlaneNoise;
        return false;
      }
      return true;
    });
  }

  /// A plane's inliers that it does not own stay without a plane.
  void set_aside(const InverseDepthPlane& plane) {
    PlanePool& pool = scratch.pool;
    pool.keep_if([&](std::size_t i) { return std::abs(pool.residual(i, plane)) > threshold(); });
  }

  std::optional<InverseDepthPlane> find_floor(const Eigen::Vector3d& normal_world) {
    fill_floor_pool();
    PlaneQuery query;
    query.threshold_sigmas = threshold();
    query.max_hypotheses = finder.settings_.max_hypotheses;
    query.expected_normal = (view.T_world_sensor.linear().transpose() * normal_world).cast<float>();
    query.cos_tolerance = std::cos(radians(finder.settings_.normal_tolerance_deg));
    const auto found = find_plane(scratch.floor_pool, query, random, scratch.ransac);
    if (!found) return std::nullopt;
    const auto settled = settle(scratch.floor_pool, *found);
    return settled && query.admits(*settled) ? settled : std::nullopt;
  }

  void find_others(std::vector<SectionPlane>& planes) {
    PlaneQuery query;
    query.threshold_sigmas = threshold();
    query.max_hypotheses = finder.settings_.max_hypotheses;
    for (int pass = 0; pass < finder.settings_.max_planes; ++pass) {
      if (static_cast<int>(scratch.pool.size()) < finder.settings_.min_points) return;
      const auto found = find_plane(scratch.pool, query, random, scratch.ransac);
      if (!found) return;
      if (const auto settled = settle(scratch.pool, *found)) {
        claim(*settled, static_cast<std::int16_t>(planes.size()));
        planes.push_back({*settled, false});
      } else {
        set_aside(*found);
      }
    }
  }
};

SectionPlaneFinder::SectionPlaneFinder(const PlaneSettings& settings, const RobotSettings& robot)
    : settings_(settings), reach_(robot) {}

std::vector<SectionPlane> SectionPlaneFinder::find(const RoiCloud& cloud, int section, const SensorView& view,
                                                   const Eigen::Vector3d& floor_normal_world,
                                                   std::uint64_t seed, std::span<std::int16_t> label,
                                                   SectionScratch& scratch) const {
  Search search{*this, cloud, view, label, scratch, Random(seed)};
  search.fill_pool(section);
  std::vector<SectionPlane> planes;
  auto floor = search.find_floor(floor_normal_world);
  if (!floor) floor = search.find_floor(Eigen::Vector3d::UnitZ());
  if (floor) {
    search.claim(*floor, 0);
    planes.push_back({*floor, true});
  }
  search.find_others(planes);
  return planes;
}

}  // namespace floornav
