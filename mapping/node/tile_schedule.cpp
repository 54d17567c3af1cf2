#include "mapping/node/tile_schedule.hpp"

#include <algorithm>
#include <cstddef>

namespace floornav {

std::vector<CellIndex> TileSchedule::due(const GridMap& map, const Eigen::Vector2d& robot_m) {
  constexpr std::size_t kRequestedPerTick = 50;
  const std::vector<CellIndex> around = tiles_within(map, robot_m, kRadius_m);
  const std::size_t share = (around.size() + kTicksPerRound - 1) / kTicksPerRound;
  auto next = std::ranges::upper_bound(around, last_sent_);
  std::set<CellIndex> due;
  for (std::size_t i = 0; i < share; ++i, ++next) {
    if (next == around.end()) next = around.begin();
    due.insert(*next);
    last_sent_ = *next;
  }
  for (std::size_t i = 0; i < kRequestedPerTick && !requested_.empty(); ++i)
    due.insert(requested_.extract(requested_.begin()).value());
  return {due.begin(), due.end()};
}

}  // namespace floornav
