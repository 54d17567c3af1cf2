#include "drivers/bumblebee/roi_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace floornav {
namespace {

struct Depths {
  double nearest_m;
  double farthest_m;
};

/// The depths at which a ray is inside the region, from `nearest_m` on.
std::optional<Depths> inside(const MatchedRegion& region, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& ray, double nearest_m) {
  const std::array<double, 3> least = {region.x_min_m, region.y_min_m, region.z_min_m};
  const std::array<double, 3> most = {region.x_max_m, region.y_max_m, region.z_max_m};
  Depths depths{nearest_m, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    double enter = (least[i] - origin[axis]) / ray[axis];
    double exit = (most[i] - origin[axis]) / ray[axis];
    if (ray[axis] == 0) {
      if (origin[axis] < least[i] || origin[axis] > most[i]) return std::nullopt;
      continue;
    }
    if (enter > exit) std::swap(enter, exit);
    depths.nearest_m = std::max(depths.nearest_m, enter);
    depths.farthest_m = std::min(depths.farthest_m, exit);
  }
  if (depths.nearest_m > depths.farthest_m) return std::nullopt;
  return depths;
}

}  // namespace

void RowSearch::add(const RowSearch& other) {
  if (other.empty()) return;
  *this = empty() ? other : RowSearch{std::min(least_px, other.least_px), std::max(most_px, other.most_px)};
}

std::vector<RowSearch> search_of(const MatchedRegion& region, const Pinhole& camera, double baseline_m,
                                 const Pose& T_body_sensor, double nearest_m) {
  constexpr int kStep_px = 4;
  const double focal_baseline = static_cast<double>(camera.fx) * baseline_m;
  std::vector<RowSearch> rows(static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; u += kStep_px) {
      const Eigen::Vector3d ray =
          T_body_sensor.linear() * camera.ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
      const auto depths = inside(region, T_body_sensor.translation(), ray, nearest_m);
      if (!depths) continue;
      rows[static_cast<std::size_t>(v)].add({static_cast<float>(focal_baseline / depths->farthest_m),
                                             static_cast<float>(focal_baseline / depths->nearest_m)});
    }
  return rows;
}

std::vector<RowSearch> search_everywhere(const Pinhole& camera, double baseline_m, double nearest_m) {
  const auto most = static_cast<float>(static_cast<double>(camera.fx) * baseline_m / nearest_m);
  return std::vector<RowSearch>(static_cast<std::size_t>(camera.height), RowSearch{0, most});
}

}  // namespace floornav
