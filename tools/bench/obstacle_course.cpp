#include "tools/bench/obstacle_course.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "tools/simulator/portable_math.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/raycaster.hpp"

namespace floornav {
namespace {

constexpr double kNear_m = 3.0;
constexpr double kNearest_m = 1.2;
constexpr double kFarthest_m = 5.5;
constexpr double kGap_m = 0.45;  ///< between obstacles
constexpr int kEach = 3;         ///< near and far
constexpr int kMostTries = 20'000;
constexpr double kVisibleShare = 0.98;  ///< of an obstacle's pixels, when the others stand there too
constexpr int kFewestPixels = 150;

Pose random_body(RandomStream& random) {
  const SinCos turn = sin_cos_deg(random.uniform(0, 360));
  Pose pose = Pose::Identity();
  pose.linear().topLeftCorner<2, 2>() << turn.cos, -turn.sin, turn.sin, turn.cos;
  pose.translation() = Eigen::Vector3d(random.uniform(-5, 5), random.uniform(-5, 5), 0);
  return pose;
}

Obstacle random_obstacle(RandomStream& random, const Pose& T_world_body, const CoveredArea& area, bool near) {
  Obstacle obstacle;
  const double far_end = std::min(kFarthest_m, area.length_m);
  const double x = near ? random.uniform(kNearest_m, kNear_m) : random.uniform(kNear_m, far_end);
  const double y = random.uniform(-0.5, 0.5) * area.width_m;
  const SinCos turn = sin_cos_deg(random.uniform(0, 360));
  obstacle.distance_m = std::sqrt(x * x + y * y);
  obstacle.footprint = {(T_world_body * Eigen::Vector3d(x, y, 0)).head<2>(),
                        {turn.cos, turn.sin},
                        {random.uniform(0.1, 0.3), random.uniform(0.1, 0.3)}};
  obstacle.height_m = random.uniform(0.05, 0.40);
  const double kind = random.uniform();
  if (kind < 0.25) {
    obstacle.footprint.half_m.y() = obstacle.footprint.half_m.x();
    obstacle.shape.cylinders.push_back(
        {obstacle.footprint.center_m, obstacle.footprint.half_m.x(), 0.0, obstacle.height_m});
    return obstacle;
  }
  obstacle.sloped = kind < 0.5;
  Block block{obstacle.footprint, 0.0, obstacle.height_m, {0, 0}};
  if (obstacle.sloped) {
    const double low_m = obstacle.height_m * random.uniform(0.4, 0.8);
    block.top_m = 0.5 * (low_m + obstacle.height_m);
    block.slope.x() = (obstacle.height_m - low_m) / (2.0 * block.footprint.half_m.x());
  }
  obstacle.shape.blocks.push_back(block);
  return obstacle;
}

bool inside(const Obstacle& obstacle, const Pose& T_world_body, const CoveredArea& area) {
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Vector2d corner =
          obstacle.footprint.world(obstacle.footprint.half_m.cwiseProduct(Eigen::Vector2d(x, y)));
      const Eigen::Vector3d body = T_world_body.inverse() * Eigen::Vector3d(corner.x(), corner.y(), 0);
      if (body.x() > area.length_m || std::fabs(body.y()) > 0.5 * area.width_m) return false;
    }
  }
  return true;
}

void add(const Shapes& shape, Shapes& all) {
  all.blocks.insert(all.blocks.end(), shape.blocks.begin(), shape.blocks.end());
  all.cylinders.insert(all.cylinders.end(), shape.cylinders.begin(), shape.cylinders.end());
}

/// Whether the corners of the block around an obstacle are all in the image.
bool in_the_image(const Obstacle& obstacle, const Pinhole& camera, const Pose& T_world_sensor) {
  const Pose T_sensor_world = T_world_sensor.inverse();
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Vector2d corner =
          obstacle.footprint.world(obstacle.footprint.half_m.cwiseProduct(Eigen::Vector2d(x, y)));
      for (const double z : {0.0, obstacle.height_m}) {
        const Eigen::Vector3d p = T_sensor_world * Eigen::Vector3d(corner.x(), corner.y(), z);
        const double u = static_cast<double>(camera.fx) * p.x() / p.z() + static_cast<double>(camera.cx);
        const double v = static_cast<double>(camera.fy) * p.y() / p.z() + static_cast<double>(camera.cy);
        if (p.z() <= 0 || u < 0 || v < 0 || u > camera.width - 1 || v > camera.height - 1) return false;
      }
    }
  }
  return true;
}

/// Counts pixels, to know who hides whom.
class Visibility {
 public:
  Visibility(const SensorSpec& sensor, const Pose& T_world_body)
      : camera_(sensor.camera),
        T_world_sensor_(T_world_body * sensor.T_body_sensor),
        floor_(cast(Shapes{})) {}

  [[nodiscard]] std::vector<float> cast(const Shapes& shapes) const {
    std::vector<float> depth(static_cast<std::size_t>(camera_.width) *
                             static_cast<std::size_t>(camera_.height));
    cast_depth(shapes, camera_, T_world_sensor_, depth);
    return depth;
  }
  /// Whether each obstacle is seen whole though the others stand there.
  [[nodiscard]] bool all_seen(const std::vector<Obstacle>& obstacles, const Shapes& all) const {
    const std::vector<float> together = cast(all);
    for (const Obstacle& obstacle : obstacles) {
      const std::vector<float> alone = cast(obstacle.shape);
      int own = 0;
      int seen = 0;
      for (std::size_t i = 0; i < alone.size(); ++i) {
        if (alone[i] == floor_[i]) continue;
        ++own;
        if (alone[i] == together[i]) ++seen;
      }
      if (own < kFewestPixels || seen < kVisibleShare * own) return false;
    }
    return true;
  }

 private:
  Pinhole camera_;
  Pose T_world_sensor_;
  std::vector<float> floor_;
};

bool keeps_apart(const Obstacle& obstacle, const std::vector<Obstacle>& others) {
  for (const Obstacle& other : others) {
    const double apart = (other.footprint.center_m - obstacle.footprint.center_m).norm();
    if (apart < other.footprint.half_m.norm() + obstacle.footprint.half_m.norm() + kGap_m) return false;
  }
  return true;
}

}  // namespace

ObstacleCourse random_course(const SensorSpec& sensor, const CoveredArea& area, std::uint64_t seed) {
  RandomStream random(random_key({seed, 0x7AB1E1}));
  ObstacleCourse course;
  course.T_world_body = random_body(random);
  const Visibility visibility(sensor, course.T_world_body);
  for (int tries = 0; tries < kMostTries; ++tries) {
    const bool near = course.obstacles.size() < kEach;
    const Obstacle obstacle = random_obstacle(random, course.T_world_body, area, near);
    if ((obstacle.distance_m < kNear_m) != near || obstacle.distance_m > kFarthest_m) continue;
    if (!inside(obstacle, course.T_world_body, area) || !keeps_apart(obstacle, course.obstacles)) continue;
    if (!in_the_image(obstacle, sensor.camera, course.T_world_body * sensor.T_body_sensor)) continue;
    std::vector<Obstacle> more = course.obstacles;
    more.push_back(obstacle);
    Shapes shapes;
    for (const Obstacle& o : more) add(o.shape, shapes);
    if (!visibility.all_seen(more, shapes)) continue;
    course.obstacles = std::move(more);
    course.shapes = std::move(shapes);
    if (course.obstacles.size() == 2 * kEach) return course;
  }
  throw std::runtime_error("no room for the obstacles of configuration " + std::to_string(seed));
}

}  // namespace floornav
