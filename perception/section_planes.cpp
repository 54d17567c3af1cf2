#include "perception/section_planes.hpp"

#include <cmath>
#include <numbers>

#include "perception/plane_kernel.hpp"
#include "perception/pool_kernel.hpp"
#include "perception/uprightness.hpp"

namespace floornav {

namespace {

/// Points that are off a plane by up to this many thresholds, where it holds most of the points, are its
/// noise.
constexpr float kNoiseBand = 1.5F;
constexpr float kPointReachSlack_m = 0.05F;
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
  Parallel& parallel;
  SectionScratch& scratch;
  Random random;
  std::vector<SectionPlane>& planes;
  const Eigen::Vector3f up = view.T_world_sensor.linear().row(2).transpose().cast<float>();  ///< sensor frame

  [[nodiscard]] float threshold() const { return static_cast<float>(finder.settings_.threshold_sigmas); }

  void fill_pool(int section) {
    const auto begin = static_cast<std::size_t>(cloud.section_begin(section));
    const auto size = static_cast<std::size_t>(cloud.section_size(section));
    scratch.claims.resize(size);
    for (std::size_t i = 0; i < size; ++i)
      scratch.claims[i] = label[begin + i] == kOutlier ? Claim::kNoise : Claim::kNone;
    take_points({cloud.ray_x.data() + begin, cloud.ray_y.data() + begin, cloud.inverse_depth.data() + begin,
                 cloud.certainty.data() + begin, cloud.block.data() + begin, nullptr,
                 static_cast<std::int32_t>(begin), size},
                scratch.claims, Claim::kNone, scratch.pool);
    scratch.blocks.begin(view.camera, scratch.pool);
  }

  /// Points where floor can be that the robot can come to: desks and walls do not compete with the floor.
  void fill_floor_pool() {
    const Eigen::Vector3f sensor =
        (view.T_world_sensor.translation() - view.T_world_body.translation()).cast<float>();
    scratch.claims.resize(scratch.pool.size());
    find_reachable(scratch.pool, view.T_world_sensor.linear().cast<float>(), sensor, finder.reach_,
                   kPointReachSlack_m, parallel, scratch.claims);
    take_points(source_of(scratch.pool), scratch.claims, Claim::kPoint, scratch.floor_pool);
  }

  /// Finds the points that the plane owns; returns how many. The floor may lie in several patches, with
  /// obstacles between them; any other plane is one patch.
  int claim_points(const PlanePool& pool, const InverseDepthPlane& plane, bool is_floor) {
    scratch.distance.resize(pool.size());
    find_distances(pool, plane, parallel, scratch.distance);
    return claim_near(pool, is_floor);
  }

  /// The same by the distances alone.
  int claim_near(const PlanePool& pool, bool is_floor) {
    scratch.claims.resize(pool.size());
    scratch.blocks.count(pool, scratch.distance, threshold());
    if (!is_floor) scratch.blocks.keep_largest_patch();
    scratch.blocks.judge();
    return find_claims(pool, scratch.distance, threshold(), kNoiseBand, scratch.blocks.states(), parallel,
                       scratch.claims);
  }

  /// Refines on the points that the plane owns; nothing where they are too few.
  std::optional<SectionPlane> settle(const PlanePool& pool, const InverseDepthPlane& found, bool is_floor) {
    if (claim_points(pool, found, is_floor) < finder.settings_.min_points) return std::nullopt;
    scratch.weights.resize(pool.size());
    for (std::size_t i = 0; i < pool.size(); ++i)
      scratch.weights[i] = scratch.claims[i] == Claim::kPoint ? 1.0F : 0.0F;
    const float upright = up.dot(found.normal());
    if (!is_floor && upright > kSideUpright)
      scratch.lower_border.leave_out(pool, cloud, view.camera, found, threshold(), scratch.weights);
    const PlaneFit fit =
        fit_inliers(pool, found, threshold(), scratch.weights, parallel, scratch.ransac.parts);
    const auto free = fit.solve();
    if (!free) return std::nullopt;
    return SectionPlane{is_floor ? *free : parallel_unless_denied(*free, fit), fit, is_floor};
  }

  /// The plane parallel to the floor that fits best, unless that fits much worse than `free`.
  [[nodiscard]] InverseDepthPlane parallel_unless_denied(const InverseDepthPlane& free,
                                                         const PlaneFit& fit) const {
    if (planes.empty() || !planes.front().dominant) return free;
    const InverseDepthPlane parallel_plane = fit.solve_parallel(planes.front().plane);
    return fit.cost(parallel_plane) - fit.cost(free) < kParallelCost ? parallel_plane : free;
  }

  /// Labels the plane's points and takes them, and the noise around them, out of the pool. False, and nothing
  /// is done, where they are too few.
  bool claim(const SectionPlane& settled) {
    const PlanePool& pool = scratch.pool;
    if (claim_points(pool, settled.plane, settled.dominant) < finder.settings_.min_points) return false;
    const bool has_room_for_two = static_cast<int>(planes.size()) < finder.settings_.max_planes;
    if (!settled.dominant && has_room_for_two) {
      const auto pair = scratch.splitter.split(pool, scratch.claims, scratch.distance, threshold());
      if (pair && claim(*pair)) return true;
      if (pair) claim_points(pool, settled.plane, false);
    }
    label_claimed([](std::size_t) { return 0; });
    planes.push_back(settled);
    return true;
  }

  /// Labels what is claimed and takes it out of the pool; `number`: which of the planes to come a point is
  /// on.
  template <class Number>
  void label_claimed(const Number& number) {
    PlanePool& pool = scratch.pool;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      if (scratch.claims[i] == Claim::kNone) continue;
      const auto index = static_cast<std::int16_t>(static_cast<int>(planes.size()) + number(i));
      label[static_cast<std::size_t>(pool.point[i])] =
          scratch.claims[i] == Claim::kPoint ? index : kPlaneNoise;
    }
    take_points(source_of(pool), scratch.claims, Claim::kNone, pool);
  }

  /// The same for the two planes between which the one in hand is a compromise.
  bool claim(const PlanePair& split) {
    const PlanePool& pool = scratch.pool;
    if (!claim_points(split)) return false;
    auto pair = scratch.splitter.refit(pool, scratch.claims, split, threshold());
    if (!pair) return false;
    for (std::size_t k = 0; k < 2; ++k)
      pair->planes[k] = parallel_unless_denied(pair->planes[k], pair->fits[k]);
    if (!claim_points(*pair) || !PlaneSplitter::both_own_points(pool, scratch.claims, *pair)) return false;
    label_claimed([&](std::size_t i) { return pair->meets_first(pool.ray_x[i], pool.ray_y[i]) ? 0 : 1; });
    for (std::size_t k = 0; k < 2; ++k) planes.push_back({pair->planes[k], pair->fits[k], false});
    return true;
  }
  bool claim_points(const PlanePair& pair) {
    const PlanePool& pool = scratch.pool;
    for (std::size_t i = 0; i < pool.size(); ++i) scratch.distance[i] = pair.distance(pool, i);
    return claim_near(pool, false) >= finder.settings_.min_points;
  }

  /// Inliers of a plane that does not own enough of them stay without a plane.
  void set_aside(const InverseDepthPlane& plane) {
    PlanePool& pool = scratch.pool;
    scratch.distance.resize(pool.size());
    scratch.claims.resize(pool.size());
    find_distances(pool, plane, parallel, scratch.distance);
    for (std::size_t i = 0; i < pool.size(); ++i)
      scratch.claims[i] = scratch.distance[i] > threshold() ? Claim::kNone : Claim::kPoint;
    take_points(source_of(pool), scratch.claims, Claim::kNone, pool);
  }

  /// First pass: the dominant floor plane.
  bool find_floor(const Eigen::Vector3d& normal_world) {
    PlaneQuery query;
    query.threshold_sigmas = threshold();
    query.max_hypotheses = finder.settings_.max_hypotheses;
    query.expected_normal = (view.T_world_sensor.linear().transpose() * normal_world).cast<float>();
    query.cos_tolerance = std::cos(radians(finder.settings_.normal_tolerance_deg));
    const auto found = find_plane(scratch.floor_pool, query, random, parallel, scratch.ransac);
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
      if (static_cast<int>(planes.size()) > finder.settings_.max_planes) return;
      if (static_cast<int>(scratch.pool.size()) < finder.settings_.min_points) return;
      const auto found = find_plane(scratch.pool, query, random, parallel, scratch.ransac);
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
                              std::span<std::int16_t> label, Parallel& parallel, SectionScratch& scratch,
                              std::vector<SectionPlane>& planes) const {
  planes.clear();
  Search search{*this, cloud, view, label, parallel, scratch, Random(seed), planes};
  search.fill_pool(section);
  search.fill_floor_pool();
  if (!search.find_floor(floor_normal_world)) search.find_floor(Eigen::Vector3d::UnitZ());
  search.find_others();
}

}  // namespace floornav
