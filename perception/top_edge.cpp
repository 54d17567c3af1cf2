#include "perception/top_edge.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "perception/uprightness.hpp"

namespace floornav {

namespace {

/// Of a top, what noise can hide next to its edge.
constexpr double kHidden_m = 0.15;
/// A side's normal points up less than this, its top's by so much more than its own.
constexpr float kSteepest = 0.9F;
constexpr float kFlatter = 0.15F;
constexpr double kParallel = 1e-6;

/// z above a cell's middle, and how it grows with x and y.
struct Height {
  double middle_m, per_x, per_y;

  Height(const Surfel& surfel, const Eigen::Vector2d& middle) {
    const Eigen::Vector3d n = surfel.normal.cast<double>();
    per_x = -n.x() / n.z();
    per_y = -n.y() / n.z();
    middle_m = surfel.centroid_m.z() + per_x * (middle.x() - surfel.centroid_m.x()) +
               per_y * (middle.y() - surfel.centroid_m.y());
  }
  [[nodiscard]] double at(const Eigen::Vector2d& from_middle) const {
    return middle_m + per_x * from_middle.x() + per_y * from_middle.y();
  }
};

/// The part of a line in a square around the origin: `begin` to `end` times its direction from its point;
/// empty where `begin` is the larger one.
struct Part {
  double begin = -1e9, end = 1e9;

  void keep_within(double half, double point, double direction) {
    if (std::abs(direction) < kParallel) {
      if (std::abs(point) > half) begin = end + 1.0;
      return;
    }
    const double a = (-half - point) / direction, b = (half - point) / direction;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
};

/// How far noise along the ray throws a point up; `thrown_m` is off the surface where that has a height of
/// its own at a place.
float thrown_up_m(const Surfel& side, float thrown_m, const Eigen::Vector2d& middle, const SensorView& view) {
  if (side.normal.z() <= kLevelUpright) return thrown_m;
  const Eigen::Vector3d ray =
      Eigen::Vector3d(middle.x(), middle.y(), side.centroid_m.z()) - view.T_world_sensor.translation();
  const double facing = std::abs(side.normal.cast<double>().dot(ray));
  const double up = std::abs(ray.z()) * static_cast<double>(side.normal.z());
  return thrown_m * static_cast<float>(std::min(1.0, up / std::max(facing, kParallel)));
}

}  // namespace

std::optional<float> edge_z_m(const Surfel& side, const Surfel& top, const Eigen::Vector2d& middle,
                              double pitch_m) {
  const Height height(top, middle);
  const Eigen::Vector3d n = side.normal.cast<double>();
  const Eigen::Vector2d across(n.x() + n.z() * height.per_x, n.y() + n.z() * height.per_y);
  const double square = across.squaredNorm();
  if (square < kParallel) return std::nullopt;
  const double off = n.dot(Eigen::Vector3d(middle.x(), middle.y(), height.middle_m) - side.centroid_m);
  const Eigen::Vector2d nearest = -off / square * across;
  if (nearest.norm() > pitch_m) return std::nullopt;
  const Eigen::Vector2d along = Eigen::Vector2d(-across.y(), across.x()).normalized();
  const double half = 0.5 * pitch_m;
  Part part;
  part.keep_within(half, nearest.x(), along.x());
  part.keep_within(half, nearest.y(), along.y());
  if (part.begin > part.end) return static_cast<float>(height.at(nearest.cwiseMax(-half).cwiseMin(half)));
  return static_cast<float>(
      std::max(height.at(nearest + part.begin * along), height.at(nearest + part.end * along)));
}

std::optional<float> edge_with_top_z_m(float top_z_m, float thrown_m, const CellEvidence& cell,
                                       const SensorView& view, const FloorEvidence& evidence) {
  const Surfel& side = evidence.surfels[static_cast<std::size_t>(cell.surfel)];
  if (side.dominant || side.normal.z() > kSteepest) return std::nullopt;
  const Eigen::Vector2d middle(evidence.lattice.center_of(cell.cell.ix),
                               evidence.lattice.center_of(cell.cell.iy));
  const double pitch_m = evidence.lattice.pitch_m;
  float edge = top_z_m - thrown_up_m(side, thrown_m, middle, view);
  bool found = false;
  for (const Surfel& top : evidence.surfels) {
    if (top.dominant || top.normal.z() < side.normal.z() + kFlatter) continue;
    const double near_m = 2.0 * static_cast<double>(top.radius_m) + kHidden_m;
    if ((top.centroid_m.head<2>() - middle).squaredNorm() > near_m * near_m) continue;
    const auto z = edge_z_m(side, top, middle, pitch_m);
    if (!z || *z < edge || *z > top_z_m) continue;
    edge = *z;
    found = true;
  }
  return found ? std::optional(edge) : std::nullopt;
}

}  // namespace floornav
