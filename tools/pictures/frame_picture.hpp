#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/pictures/raster.hpp"
#include "tools/pictures/robot_mark.hpp"

namespace floornav {

/// What the sensor saw in one frame beside the map that came of it.
struct FramePicture {
  int image_width = 0;                ///< px
  int image_height = 0;               ///< px
  std::vector<std::uint32_t> pixels;  ///< packed colours of the sensor's image, row by row
  MapRaster map;
  RobotMark robot;
  std::string title;
  std::string subtitle;
};

/// The colour of a pixel of the sensor's image: grey by its distance, tinted where its point stands for a
/// free or a blocked vertex; black where nothing was measured (depth 0).
std::uint32_t pixel_color(double depth_m, VertexState state);

/// Throws std::runtime_error where the file cannot be written.
void write_frame_png(const FramePicture& picture, const std::filesystem::path& file);

}  // namespace floornav
