#pragma once

#include <cstdint>
#include <vector>

#include "floornav/grid_map_t.hpp"
#include "mapping/grid_map.hpp"
#include "runtime/geometry/pose.hpp"

namespace floornav {

/// What every part of one update tells beside its tiles.
struct GridMapHeader {
  std::int64_t utime_us = 0;  ///< of the newest evidence in the map
  float step_m = 0;           ///< T of eq. (2)
  Pose T_world_body = Pose::Identity();
};

/// The listed tiles of a map, in this order, in as many messages of at most kMapMessageBytes as it takes. A
/// listed tile that the map does not hold becomes an empty one: "forget it". No tile at all makes one message
/// without tiles.
std::vector<grid_map_t> to_messages(const GridMap& map, const std::vector<CellIndex>& tiles,
                                    const GridMapHeader& header);

/// The grid-map as a subscriber holds it, put together from messages of which any may be lost.
class GridMapReceiver {
 public:
  struct Change {
    bool restarted = false;        ///< the map was emptied first: new mapper, epoch or resolution
    std::vector<CellIndex> tiles;  ///< those that differ now (not in age alone), in the message's order
  };

  /// Takes what is newer than what is held. Throws std::invalid_argument, and nothing changes, for a message
  /// that is corrupt or of an older epoch.
  Change apply(const grid_map_t& message);

  [[nodiscard]] const GridMap& map() const { return map_; }
  [[nodiscard]] const GridMapHeader& header() const { return header_; }
  /// False until the first message.
  [[nodiscard]] bool started() const { return started_; }

 private:
  bool restart_if_needed(const grid_map_t& message);

  GridMap map_;
  GridMapHeader header_;
  std::int64_t session_ = 0;
  bool started_ = false;
};

}  // namespace floornav
