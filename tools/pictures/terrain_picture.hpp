#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tools/pictures/raster.hpp"

namespace floornav {

/// Everything that terrain.png shows.
struct TerrainPicture {
  HeightRaster terrain;
  std::vector<Eigen::Vector2d> trajectory;  ///< of the body
  std::string title;
  std::string subtitle;
  double longest_px = 1000;
};

/// Heights as colours, lit from the north-west so that small steps show, with a colour bar. Throws
/// std::runtime_error where the file cannot be written.
void write_terrain_png(const TerrainPicture& picture, const std::filesystem::path& file);

}  // namespace floornav
