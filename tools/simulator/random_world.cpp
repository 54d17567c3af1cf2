#include "tools/simulator/random_world.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tools/simulator/portable_math.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/true_route.hpp"

namespace floornav {
namespace {

constexpr double kTruth_m = 0.05;
constexpr double kMargin_m = 0.10;      ///< that some way has beside the robot
constexpr double kFreeAtStart_m = 1.3;  ///< nearest to the start that anything stands
constexpr double kFreeAtGoal_m = 0.9;
constexpr double kShortest_m = 3.5;  ///< from start to goal, as the crow flies
constexpr double kWall_m = 1.2;
constexpr int kMostTries = 200;
constexpr double kShoulder_m = 0.3;
constexpr double kShortestWalk_m = 2.0;

/// Fills a room with things of which the difficulty decides how many and which.
class Furnisher {
 public:
  Furnisher(std::uint64_t key, double difficulty) : random_(key), difficulty_(difficulty) {}

  Scene furnish() {
    build_room();
    choose_goal();
    if (random_.uniform() < 0.7 * difficulty_) add_platform();
    if (random_.uniform() < 0.5 * difficulty_) add_ramp();
    if (random_.uniform() < 0.5 * difficulty_) add_drop();
    const int things = 3 + static_cast<int>(difficulty_ * random_.uniform(6, 12));
    for (int i = 0; i < things; ++i) add_thing();
    return std::move(scene_);
  }

 private:
  void build_room() {
    scene_.name = "random";
    const double width = random_.uniform(5.0, 8.0);
    const double south = -random_.uniform(0.35, 0.65) * width;
    scene_.area_min_m = {-1.5, south};
    scene_.area_max_m = {random_.uniform(6.0, 9.0), south + width};
    const Eigen::Vector2d low = scene_.area_min_m;
    const Eigen::Vector2d high = scene_.area_max_m;
    add_wall(low, {high.x(), low.y()});
    add_wall({high.x(), low.y()}, high);
    add_wall(high, {low.x(), high.y()});
    add_wall({low.x(), high.y()}, low);
  }

  void add_wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const double length = (to - from).norm();
    scene_.fixed.blocks.push_back(
        {{0.5 * (from + to), (to - from) / length, {0.5 * length, 0.05}}, 0.0, kWall_m, {0, 0}});
  }

  Eigen::Vector2d place(double from_wall_m) {
    const double x =
        random_.uniform(scene_.area_min_m.x() + from_wall_m, scene_.area_max_m.x() - from_wall_m);
    return {x, random_.uniform(scene_.area_min_m.y() + from_wall_m, scene_.area_max_m.y() - from_wall_m)};
  }

  void choose_goal() {
    Eigen::Vector2d goal = place(1.0);
    for (int i = 0; i < kMostTries && goal.norm() < kShortest_m; ++i) goal = place(1.0);
    scene_.goal_m = goal;
  }

  Footprint footprint(double least_half_m, double most_half_m) {
    const SinCos turn = sin_cos_deg(random_.uniform(0, 360));
    const double x = random_.uniform(least_half_m, most_half_m);
    const Eigen::Vector2d half(x, random_.uniform(least_half_m, most_half_m));
    return {place(0.3), {turn.cos, turn.sin}, half};
  }

  [[nodiscard]] bool leaves_room(const Footprint& footprint) const {
    const double reach = footprint.half_m.norm();
    return footprint.center_m.norm() > reach + kFreeAtStart_m &&
           (footprint.center_m - *scene_.goal_m).norm() > reach + kFreeAtGoal_m;
  }

  void add_thing() {
    const Footprint f = footprint(0.1, 0.45);
    const double kind = random_.uniform();
    const double height = random_.uniform();
    if (!leaves_room(f)) return;
    if (kind < 0.15) {
      scene_.fixed.cylinders.push_back({f.center_m, f.half_m.x(), 0.0, 0.3 + 0.7 * height});
    } else if (kind < 0.15 + 0.2 * difficulty_) {  // a low thing that it cannot climb
      scene_.fixed.blocks.push_back({f, 0.0, 0.05 + 0.05 * height, {0, 0}});
    } else if (kind < 0.15 + 0.3 * difficulty_) {  // a thin leg
      scene_.fixed.cylinders.push_back({f.center_m, 0.02, 0.0, 0.4 + 0.4 * height});
    } else {
      scene_.fixed.blocks.push_back({f, 0.0, 0.15 + 0.8 * height, {0, 0}});
    }
  }

  /// A step that the wheels climb.
  void add_platform() {
    const Footprint f = footprint(0.5, 1.2);
    const double height = random_.uniform(0.008, 0.016);
    if (leaves_room(f)) scene_.fixed.blocks.push_back({f, 0.0, height, {0, 0}});
  }

  void add_ramp() {
    Footprint f = footprint(0.7, 0.9);
    const double height = random_.uniform(0.05, 0.12);
    const Block ramp{f, 0.0, 0.5 * height, {0.5 * height / f.half_m.x(), 0}};
    if (leaves_room(f)) scene_.fixed.blocks.push_back(ramp);
  }

  void add_drop() {
    const Footprint f = footprint(0.3, 0.7);
    const double depth = random_.uniform(0.1, 0.6);
    if (leaves_room(f)) scene_.fixed.holes.push_back({f, -depth});
  }

  RandomStream random_;
  double difficulty_;
  Scene scene_;
};

bool walkable(const TruthGrid& truth, const Person& person) {
  const Eigen::Vector2d way = person.to_m - person.from_m;
  const int samples = static_cast<int>(way.norm() / truth.lattice.pitch_m);
  for (int i = 0; i <= samples; ++i) {
    const Eigen::Vector2d middle = person.from_m + way * i / std::max(samples, 1);
    for (const double x : {-kShoulder_m, 0.0, kShoulder_m}) {
      for (const double y : {-kShoulder_m, 0.0, kShoulder_m}) {
        const TruthCell* const cell = truth.at(middle + Eigen::Vector2d(x, y));
        if (cell == nullptr || !cell->drivable) return false;
      }
    }
  }
  return true;
}

/// People whose ways are free of things, and who do not stand at the start or at the goal.
void add_people(std::uint64_t key, int count, RandomWorld& world) {
  RandomStream random(key);
  Scene& scene = world.scene;
  const auto place = [&] {
    const double x = random.uniform(scene.area_min_m.x(), scene.area_max_m.x());
    return Eigen::Vector2d(x, random.uniform(scene.area_min_m.y(), scene.area_max_m.y()));
  };
  const auto in_the_way = [&](const Eigen::Vector2d& p) {
    return p.norm() < kFreeAtStart_m || (p - *scene.goal_m).norm() < kFreeAtGoal_m;
  };
  for (int tries = 0; tries < kMostTries * count && std::ssize(scene.people) < count; ++tries) {
    Person person;
    person.from_m = place();
    person.to_m = place();
    person.speed_mps = random.uniform(0.5, 1.2);
    if ((person.to_m - person.from_m).norm() < kShortestWalk_m) continue;
    if (in_the_way(person.from_m) || in_the_way(person.to_m) || !walkable(world.truth, person)) continue;
    scene.people.push_back(person);
  }
}

}  // namespace

RandomWorld random_world(std::uint64_t seed, double difficulty, int people, const RobotSettings& robot) {
  for (std::uint64_t attempt = 0; attempt < kMostTries; ++attempt) {
    RandomWorld world;
    world.scene = Furnisher(random_key({seed, attempt, 0x3081D}), difficulty).furnish();
    world.truth = truth_of(world.scene, robot, kTruth_m, {0, 0});
    if (!shortest_way_m(world.truth, robot.radius_m + kMargin_m, {0, 0}, *world.scene.goal_m, 0.0)) continue;
    world.scene.name = "random world " + std::to_string(seed);
    add_people(random_key({seed, attempt, 0x3081E}), people, world);
    return world;
  }
  throw std::runtime_error("no world with a way through it for seed " + std::to_string(seed));
}

}  // namespace floornav
