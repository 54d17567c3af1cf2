#pragma once

#include <cstdint>
#include <vector>

#include "floornav/terrain_map_t.hpp"
#include "mapping/terrain_map.hpp"

namespace floornav {

/// The listed tiles that the map holds, in this order, in as many messages of at most kMapMessageBytes as it
/// takes; none where the list is empty. `utime_us`: of the newest evidence in the map.
std::vector<terrain_map_t> to_messages(const TerrainMap& map, const std::vector<CellIndex>& tiles,
                                       std::int64_t utime_us);

/// The terrain as a subscriber holds it, put together from messages of which any may be lost.
class TerrainMapReceiver {
 public:
  /// Takes the message's tiles. Throws std::invalid_argument, and nothing changes, for a message that is
  /// corrupt or of an older epoch.
  void apply(const terrain_map_t& message);

  [[nodiscard]] const TerrainMap& map() const { return map_; }

 private:
  TerrainMap map_;
  std::int64_t session_ = 0;
  bool started_ = false;
};

}  // namespace floornav
