#include "tools/bench/step_course.hpp"

#include <Eigen/Geometry>

#include "tools/simulator/portable_math.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

constexpr double kMostTurn_deg = 35.0;
constexpr double kStripLength_m = 8.0;
constexpr double kRunUp_m = 4.0;   ///< of a strip on which the robot stands, behind it
constexpr double kRunOut_m = 4.0;  ///< of a strip beyond the last edge
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
  const bool stands_high = random.uniform() < 0.5;
  const double above_top_m = kCameraHeight_m - (stands_high ? 0.0 : height_m);
  StepCourse course;
  std::vector<Eigen::Vector2d> sides;  // where strips begin and end, one after the other
  if (stands_high) sides.emplace_back(robot.position_m - kRunUp_m * across);
  for (std::size_t i = 0; i < kStepDistances_m.size(); ++i) {
    const bool falls = (i % 2 == 0) == stands_high;
    const double hidden_m = falls ? height_m * kStepDistances_m[i] / above_top_m : 0.0;
    sides.emplace_back(robot.position_m + kStepDistances_m[i] * robot.ahead);
    course.edges.push_back({sides.back(), across, falls ? -height_m : height_m, hidden_m});
  }
  if (stands_high) sides.emplace_back(sides.back() + kRunOut_m * across);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const double width_m = across.dot(sides[i + 1] - sides[i]);
    const Footprint strip{0.5 * (sides[i] + sides[i + 1]), across, {0.5 * width_m, 0.5 * kStripLength_m}};
    course.shapes.blocks.push_back({strip, 0.0, height_m, {0, 0}});
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
