#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "runtime/process/replay_executor.hpp"
#include "tools/pictures/raster.hpp"
#include "tools/replay/log_contents.hpp"
#include "tools/replay/observer.hpp"
#include "tools/replay/replay.hpp"

namespace floornav {

/// What the frames add up to.
struct FrameTotals {
  std::int64_t frames = 0;
  std::int64_t points = 0;  ///< in the region of interest's sections
  std::int64_t sections_processed = 0;
  std::int64_t sections_skipped = 0;
  std::int64_t surfels = 0;
  std::int64_t frames_with_floor = 0;
};

/// Square metres of a map by state.
struct MapArea {
  double free_m2 = 0;
  double blocked_m2 = 0;
  [[nodiscard]] double seen_m2() const { return free_m2 + blocked_m2; }
};
MapArea area_of(const MapRaster& map);

/// "following", "frontier", ... of path_t.status.
std::string path_status_name(std::int8_t status);

/// Everything that summary.json tells.
struct Summary {
  const ReplayRequest& request;
  const LogContents& log;
  const ReplayExecutor& executor;
  const std::vector<Node*>& nodes;  ///< in the executor's order
  const Observer& observer;
  const FrameTotals& totals;
  const MapRaster& map;
  bool interrupted = false;
  std::chrono::nanoseconds took{0};
};
void write_summary(const Summary& summary, const std::filesystem::path& file);

}  // namespace floornav
