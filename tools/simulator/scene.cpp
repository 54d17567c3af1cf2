#include "tools/simulator/scene.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr double kStride_m = 0.7;
constexpr double kStepReach_m = 0.25;  ///< of a foot before and behind the body
constexpr double kHipWidth_m = 0.18;

/// Goes 0, 1, 0, 1 ... in straight lines, one unit of `x` each.
double to_and_fro(double x) {
  const double turn = x - 2.0 * std::floor(x / 2.0);
  return turn <= 1.0 ? turn : 2.0 - turn;
}

void add_person(const Person& person, double ground_m, double time_s, std::vector<Cylinder>& cylinders) {
  const Eigen::Vector2d way = person.to_m - person.from_m;
  const double length_m = way.norm();
  const Eigen::Vector2d ahead = way / length_m;
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const double walked_m = std::max(0.0, time_s - person.start_s) * person.speed_mps;
  const Eigen::Vector2d body = person.from_m + way * to_and_fro(walked_m / length_m);
  const double foot_m = kStepReach_m * (2.0 * to_and_fro(walked_m / kStride_m) - 1.0);
  const double h = person.height_m;
  for (const double side : {-1.0, 1.0})
    cylinders.push_back(
        {body + side * (foot_m * ahead + 0.5 * kHipWidth_m * left), 0.07, ground_m, ground_m + 0.47 * h});
  cylinders.push_back({body, 0.17, ground_m + 0.47 * h, ground_m + 0.84 * h});
  cylinders.push_back({body, 0.10, ground_m + 0.84 * h, ground_m + h});
}

}  // namespace

Shapes Scene::at(double time_s) const {
  Shapes shapes = fixed;
  for (const Person& person : people)
    add_person(person, fixed.ground.z_m(person.from_m), time_s, shapes.cylinders);
  return shapes;
}

}  // namespace floornav
