#pragma once

#include <string>
#include <vector>

#include "tools/simulate/drive_base.hpp"
#include "tools/simulator/scene.hpp"

namespace floornav {

/// The people of a scene while a robot drives through it: they walk on, but for those who would come too near
/// to it.
class Walkers {
 public:
  explicit Walkers(const Scene& scene);

  void walk(const Eigen::Vector2d& robot_m, double time_s);

  /// Everything that stands in the scene now, people included.
  [[nodiscard]] Shapes world() const;
  /// What happened between the robot and the person nearest to it; empty where it touches none.
  [[nodiscard]] std::string meeting(const DriveBase& robot) const;

 private:
  [[nodiscard]] Eigen::Vector2d place_of(std::size_t person) const;
  [[nodiscard]] std::string tell(const DriveBase& robot) const;

  const Scene& scene_;
  std::vector<double> walked_s_;  ///< how long each has walked
  std::vector<double> waited_s_;  ///< for how long each has waited for the robot, 0: walks
};

}  // namespace floornav
