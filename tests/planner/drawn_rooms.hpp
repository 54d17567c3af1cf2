#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "map_drawing.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

inline constexpr double kCell_m = 0.1;

inline Pose pose_at(double x_m, double y_m) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
  return pose;
}

inline RobotSettings robot() {
  RobotSettings settings;
  settings.radius_m = 0.3;
  return settings;
}

/// A room of free floor, `wide` x `high` cells, with walls around it.
inline std::vector<std::string> room(std::size_t wide, std::size_t high) {
  std::string row(wide, '.');
  row.front() = row.back() = '#';
  std::vector<std::string> rows(high, row);
  rows.front() = rows.back() = std::string(wide, '#');
  return rows;
}

inline void fill(std::vector<std::string>& rows, std::size_t x0, std::size_t y0, std::size_t x1,
                 std::size_t y1, char what) {
  for (std::size_t y = y0; y < y1; ++y)
    for (std::size_t x = x0; x < x1; ++x) rows[y][x] = what;
}

}  // namespace floornav
