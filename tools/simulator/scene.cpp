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

double walked_m(const Person& person, double time_s) {
  return std::max(0.0, time_s - person.start_s) * person.speed_mps;
}

void add_person(const Person& person, double ground_m, double time_s, std::vector<Cylinder>& cylinders) {
  const Eigen::Vector2d ahead = (person.to_m - person.from_m).normalized();
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const Eigen::Vector2d body = person.place_m(time_s);
  const double foot_m = kStepReach_m * (2.0 * to_and_fro(walked_m(person, time_s) / kStride_m) - 1.0);
  const double h = person.height_m;
  for (const double side : {-1.0, 1.0})
    cylinders.push_back(
        {body + side * (foot_m * ahead + 0.5 * kHipWidth_m * left), 0.07, ground_m, ground_m + 0.47 * h});
  cylinders.push_back({body, 0.17, ground_m + 0.47 * h, ground_m + 0.84 * h});
  cylinders.push_back({body, 0.10, ground_m + 0.84 * h, ground_m + h});
}

}  // namespace

Eigen::Vector2d Person::place_m(double time_s) const {
  const Eigen::Vector2d way = to_m - from_m;
  return from_m + way * to_and_fro(walked_m(*this, time_s) / way.norm());
}

std::vector<Cylinder> Scene::people_at(std::span<const double> times_s) const {
  std::vector<Cylinder> cylinders;
  for (std::size_t i = 0; i < people.size(); ++i)
    add_person(people[i], fixed.ground.z_m(people[i].from_m), times_s[i], cylinders);
  return cylinders;
}

Shapes Scene::at(double time_s) const {
  Shapes shapes = fixed;
  const auto walkers = people_at(std::vector<double>(people.size(), time_s));
  shapes.cylinders.insert(shapes.cylinders.end(), walkers.begin(), walkers.end());
  return shapes;
}

}  // namespace floornav
