#pragma once

#include <filesystem>

#include "tools/pictures/raster.hpp"

namespace floornav {

/// Writes map.pgm (white free, black blocked, grey unknown), belief.tiff and height.tiff (float32, NaN =
/// unknown) and map.yaml, which gives the place of all three in the form of map_server. Row 0 of the images
/// is the highest y. Throws std::runtime_error for a file that cannot be written.
void write_map_files(const MapRaster& map, const std::filesystem::path& folder);

}  // namespace floornav
