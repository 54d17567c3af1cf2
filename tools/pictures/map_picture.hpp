#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/pictures/raster.hpp"
#include "tools/pictures/robot_mark.hpp"

namespace floornav {

/// A disc of floor that the planner took for granted.
struct AssumedDisc {
  Eigen::Vector2d center_m;
  double radius_m = 0;
};

/// Everything that map.png shows.
struct MapPicture {
  MapRaster map;
  std::vector<Eigen::Vector2d> trajectory;  ///< of the body
  std::vector<Eigen::Vector2d> path;
  std::vector<std::vector<Eigen::Vector2d>> roads;  ///< of a roadmap
  std::optional<RobotMark> robot;
  std::optional<Eigen::Vector2d> goal;
  std::optional<AssumedDisc> assumed_floor;
  std::vector<std::vector<Eigen::Vector2d>> true_outlines;  ///< closed, of what truly stands there
  std::string title;
  std::string subtitle;
  double longest_px = 1000;
};

/// Unknown, free and blocked cells shaded by belief, with what was driven and what is planned. Throws
/// std::runtime_error where the file cannot be written.
void write_map_png(const MapPicture& picture, const std::filesystem::path& file);

}  // namespace floornav
