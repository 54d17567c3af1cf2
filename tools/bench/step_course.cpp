#include "tools/bench/step_course.hpp"

#include <Eigen/Geometry>

#include "tools/simulator/portable_math.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

constexpr double kMostTurn_deg = 35.0;
constexpr double kStripLength_m = 8.0;
constexpr double kMostSlope = 0.03;
constexpr double kCameraHeight_m = 0.72;

PlanarState random_state(RandomStream& random) {
  const SinCos turn = sin_cos_deg(random.uniform(0, 360));
  const double x = random.uniform(-5, 5);
  return {{x, random.uniform(-5, 5)}, {turn.cos, turn.sin}};
}

}  // namespace

StepCourse step_course(double height_m, std::uint64_t seed) {
  RandomStream random(random_key({seed, 0x57E9}));
  const PlanarState robot = random_state(random);
  const SinCos turn = sin_cos_deg(random.uniform(-kMostTurn_deg, kMostTurn_deg));
  const Eigen::Vector2d left(-robot.ahead.y(), robot.ahead.x());
  const Eigen::Vector2d across = turn.cos * robot.ahead + turn.sin * left;
  StepCourse course;
  for (std::size_t i = 0; i < kStepDistances_m.size(); ++i) {
    const double rise_m = i % 2 == 0 ? height_m : -height_m;
    const double hidden_m = rise_m < 0 ? height_m * kStepDistances_m[i] / (kCameraHeight_m - height_m) : 0.0;
    course.edges.push_back({robot.position_m + kStepDistances_m[i] * robot.ahead, across, rise_m, hidden_m});
  }
  for (std::size_t i = 0; i + 1 < course.edges.size(); i += 2) {
    const Eigen::Vector2d from = course.edges[i].middle_m;
    const Eigen::Vector2d to = course.edges[i + 1].middle_m;
    const double width_m = across.dot(to - from);
    course.shapes.blocks.push_back(
        {{0.5 * (from + to), across, {0.5 * width_m, 0.5 * kStripLength_m}}, 0.0, height_m, {0, 0}});
  }
  course.T_world_body = body_on_floor(course.shapes, robot);
  return course;
}

StepCourse plain_course(std::uint64_t seed) {
  RandomStream random(random_key({seed, 0xF1A7}));
  StepCourse course;
  const PlanarState robot = random_state(random);
  if (random.uniform() < 0.5) {
    const double x = random.uniform(-kMostSlope, kMostSlope);
    course.shapes.ground.slope = {x, random.uniform(-kMostSlope, kMostSlope)};
  }
  course.T_world_body = body_on_floor(course.shapes, robot);
  return course;
}

}  // namespace floornav
