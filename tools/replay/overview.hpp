#pragma once

#include <filesystem>

#include "tools/pictures/raster.hpp"
#include "tools/replay/observer.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/summary.hpp"

namespace floornav {

/// What the pictures of a whole replay tell.
struct Overview {
  const ReplayRequest& request;
  const LogContents& log;
  const Observer& observer;
  const FrameTotals& totals;
};

/// map.png
void draw_map(const Overview& overview, const MapRaster& map, const std::filesystem::path& file);
/// terrain.png
void draw_terrain(const Overview& overview, const std::filesystem::path& file);

}  // namespace floornav
