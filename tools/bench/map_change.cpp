#include "tools/bench/map_change.hpp"

#include <algorithm>
#include <vector>

#include "tools/bench/frame_stack.hpp"
#include "tools/bench/map_accuracy.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/scene.hpp"

namespace floornav {
namespace {

constexpr double kFrames_per_s = 10;
constexpr int kFramesBefore = 10;
constexpr int kFramesAfter = 10;  // 1 s
constexpr int kMostFrames = 20;
constexpr double kCell_m = 0.05;

Block box(double x_m, double y_m, double height_m) {
  return {{{x_m, y_m}, {1, 0}, {0.2, 0.2}}, -1.0, height_m, {0, 0}};
}

/// Cells of a box' top that are not at its border, and how many of them are blocked.
double blocked_share(const GridMap& map, const Footprint& footprint) {
  int cells = 0;
  int blocked = 0;
  const Eigen::Vector2d half = footprint.half_m.array() - kCell_m;
  for (double x = -half.x(); x <= half.x(); x += kCell_m) {
    for (double y = -half.y(); y <= half.y(); y += kCell_m, ++cells) {
      const Eigen::Vector2d at = footprint.world({x, y});
      blocked += map.state(map.lattice().cell_of(at.x(), at.y())) == VertexState::kBlocked ? 1 : 0;
    }
  }
  return static_cast<double>(blocked) / cells;
}

/// One robot that stands at the origin.
class Watch {
 public:
  Watch(const MapChangeOptions& options, std::uint64_t key)
      : sensor_(kinect(options.width), key),
        stack_(PerceptionSettings{}, MappingSettings{}, RobotSettings{}) {}

  void see(const Shapes& shapes) {
    stack_.see(sensor_, sensor_.measure(shapes, Pose::Identity(), frame_), Pose::Identity());
    ++frame_;
  }
  [[nodiscard]] const GridMap& map() const { return stack_.published(); }
  [[nodiscard]] const SensorSpec& sensor() const { return sensor_.model(); }

 private:
  DepthSensor sensor_;
  FrameStack stack_;
  std::int64_t frame_ = 0;
};

/// Across the view, near or far, or away from the robot.
Person walker(RandomStream& random) {
  Person person;
  const double x_m = random.uniform(1.5, 3.0);
  person.speed_mps = random.uniform(0.6, 1.4);
  if (random.uniform() < 0.7) {
    person.from_m = {x_m, -2.5};
    person.to_m = {x_m + random.uniform(-0.5, 0.5), 2.5};
  } else {
    person.from_m = {1.2, random.uniform(-0.2, 0.2)};
    person.to_m = {6.5, random.uniform(-1.0, 1.0)};
  }
  return person;
}

MapChange watch_walk(const MapChangeOptions& options, std::uint64_t key) {
  RandomStream random(key);
  Scene scene;
  scene.area_min_m = {-1, -3};
  scene.area_max_m = {7, 3};
  scene.fixed.blocks = {box(2.2, -0.6, 0.2), {{{7, 0}, {1, 0}, {0.1, 4}}, -1.0, 2.0, {0, 0}}};
  scene.people = {walker(random)};
  Watch watch(options, key);
  for (int i = 0; i < kFramesBefore; ++i) watch.see(scene.fixed);
  const Footprint standing = scene.fixed.blocks.front().footprint;
  const double stood = blocked_share(watch.map(), standing);
  const Person& person = scene.people.front();
  const double walk_s = (person.to_m - person.from_m).norm() / person.speed_mps;
  for (int i = 0; i < walk_s * kFrames_per_s; ++i) watch.see(scene.at(i / kFrames_per_s));
  for (int i = 0; i < kFramesAfter; ++i) watch.see(scene.fixed);
  MapChange change;
  const TruthGrid truth = truth_of(scene, RobotSettings{}, kCell_m, {0, 0});
  MapAccuracy accuracy;
  judge_map(watch.map(), truth, Pose::Identity(), watch.sensor(), {}, accuracy);
  change.trail = static_cast<double>(accuracy.drivable_blocked) / static_cast<double>(accuracy.drivable);
  change.eroded = std::max(0.0, stood - blocked_share(watch.map(), standing));
  Shapes changed = scene.fixed;
  changed.blocks.push_back(box(random.uniform(1.6, 2.6), random.uniform(0.2, 0.6), random.uniform(0.1, 0.4)));
  while (change.frames_until_blocked < kMostFrames &&
         blocked_share(watch.map(), changed.blocks.back().footprint) < 0.5) {
    watch.see(changed);
    ++change.frames_until_blocked;
  }
  return change;
}

}  // namespace

MapChange measure_map_change(const MapChangeOptions& options, Parallel& parallel) {
  std::vector<MapChange> walks(static_cast<std::size_t>(options.walks));
  parallel.run(options.walks, [&](int walk, int) {
    const auto i = static_cast<std::size_t>(walk);
    walks[i] = watch_walk(options, random_key({options.seed, i, 0x3A1C}));
  });
  MapChange worst;
  for (const MapChange& walk : walks) {
    worst.trail = std::max(worst.trail, walk.trail);
    worst.trail_mean += walk.trail / options.walks;
    worst.frames_until_blocked = std::max(worst.frames_until_blocked, walk.frames_until_blocked);
    worst.eroded = std::max(worst.eroded, walk.eroded);
  }
  return worst;
}

}  // namespace floornav
