#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace floornav {

/// A 16-bit image, row by row; 0 = no measurement.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> pixels;
};

/// Reads a one-channel 16-bit PNG, TIFF or PGM. Throws std::runtime_error "FILE: what is wrong" for anything
/// else and for a damaged file.
DepthImage read_depth_image(const std::filesystem::path& file);

/// The images (.png, .tif, .tiff, .pgm) of a folder by name. Throws std::runtime_error where there is none.
std::vector<std::filesystem::path> depth_images_in(const std::filesystem::path& folder);

}  // namespace floornav
