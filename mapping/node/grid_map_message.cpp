#include "mapping/node/grid_map_message.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include "mapping/node/map_message_size.hpp"

namespace floornav {
namespace {

using Seen = GridTile::Seen;
constexpr std::int32_t kOldestAge = std::numeric_limits<std::int16_t>::max();

/// What is newer than `now` has come out of order: it is as new as can be.
std::int16_t age_of(std::uint32_t seen, std::uint32_t now) {
  if (seen == 0) return -1;
  const std::uint32_t age = now - seen;
  const bool from_later = age > std::numeric_limits<std::uint32_t>::max() / 2;
  return static_cast<std::int16_t>(from_later ? 0 : std::min<std::uint32_t>(age, kOldestAge));
}

std::uint32_t seen_of(std::int16_t age, std::uint32_t now) {
  if (age < 0) return 0;
  const std::uint32_t seen = now - static_cast<std::uint32_t>(age);
  return seen == 0 ? 1 : seen;
}

grid_tile_t to_message(CellIndex index, const GridTile* tile, std::int64_t utime_us) {
  grid_tile_t message{};
  message.ix = index.ix;
  message.iy = index.iy;
  if (tile == nullptr) return message;
  message.version = tile->version;
  message.origin_z = tile->origin_z_m;
  message.side = GridTile::kSide;
  message.count = GridTile::kVertices;
  message.belief.assign(tile->belief.begin(), tile->belief.end());
  message.height.assign(tile->height.begin(), tile->height.end());
  std::ranges::transform(tile->sigma, std::back_inserter(message.sigma), sigma_counts);
  message.slope.assign(tile->slope.begin(), tile->slope.end());
  message.edges.assign(tile->edges.begin(), tile->edges.end());
  const std::uint32_t now = Seen::at(utime_us);
  for (std::size_t i = 0; i < tile->state.size(); ++i) {
    message.state.push_back(static_cast<std::uint8_t>(tile->state[i]));
    message.clearance.push_back(tile->clearance[i]);
    message.age.push_back(age_of(tile->seen[i], now));
  }
  return message;
}

grid_map_t without_tiles(const GridMap& map, const GridMapHeader& header) {
  grid_map_t message{};
  message.utime = header.utime_us;
  message.epoch = map.epoch;
  message.version = map.version;
  message.resolution = static_cast<float>(map.lattice().pitch_m);
  message.step = header.step_m;
  pose_to_arrays(header.T_world_body, message.body_pos, message.body_orientation);
  return message;
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("grid map: ") + what);
}

void check(const grid_tile_t& tile, std::int64_t map_version) {
  constexpr std::int32_t kFarthestTile = std::numeric_limits<std::int32_t>::max() / GridTile::kSide - 1;
  require(std::abs(static_cast<std::int64_t>(tile.ix)) <= kFarthestTile &&
              std::abs(static_cast<std::int64_t>(tile.iy)) <= kFarthestTile,
          "tile index out of range");
  if (tile.side == 0 && tile.count == 0) return;
  require(tile.side == GridTile::kSide && tile.count == GridTile::kVertices, "tile of another size");
  require(tile.version >= 0 && tile.version <= map_version, "tile newer than its map");
  require(std::isfinite(tile.origin_z), "height that is not finite");
  const auto full = [](const auto& array) {
    return array.size() == static_cast<std::size_t>(GridTile::kVertices);
  };
  require(full(tile.state) && full(tile.belief) && full(tile.height) && full(tile.sigma) &&
              full(tile.slope) && full(tile.clearance) && full(tile.edges) && full(tile.age),
          "array of another size than its count");
  require(std::ranges::all_of(tile.state, [](std::uint8_t state) { return state <= grid_tile_t::BLOCKED; }),
          "state that does not exist");
}

void check(const grid_map_t& message) {
  require(message.utime >= 0 && message.epoch >= 0 && message.version >= 0,
          "negative time, epoch or version");
  require(std::isfinite(message.resolution) && message.resolution >= 0.001F && message.resolution <= 10.0F,
          "absurd resolution");
  require(std::isfinite(message.step) && message.step >= 0, "absurd step");
  for (const grid_tile_t& tile : message.tiles) check(tile, message.version);
}

void take(const grid_tile_t& message, std::int64_t utime_us, GridTile& tile) {
  tile.version = message.version;
  tile.origin_z_m = message.origin_z;
  std::ranges::copy(message.belief, tile.belief.begin());
  std::ranges::copy(message.height, tile.height.begin());
  std::ranges::transform(message.sigma, tile.sigma.begin(), sigma_code);
  std::ranges::copy(message.slope, tile.slope.begin());
  std::ranges::copy(message.edges, tile.edges.begin());
  const std::uint32_t now = Seen::at(utime_us);
  tile.clearance = {};
  tile.seen = {};
  for (std::size_t i = 0; i < tile.state.size(); ++i) {
    tile.state[i] = static_cast<VertexState>(message.state[i]);
    tile.clearance.set(i, message.clearance[i]);
    tile.seen.set(i, seen_of(message.age[i], now));
  }
}

}  // namespace

std::vector<grid_map_t> to_messages(const GridMap& map, const std::vector<CellIndex>& tiles,
                                    const GridMapHeader& header) {
  std::vector<grid_map_t> messages{without_tiles(map, header)};
  MessageSize size(static_cast<std::size_t>(messages.front().getEncodedSize()));
  for (const CellIndex index : tiles) {
    grid_tile_t tile = to_message(index, map.find(index), header.utime_us);
    if (size.needs_new_message(static_cast<std::size_t>(tile.getEncodedSize())))
      messages.push_back(without_tiles(map, header));
    messages.back().tiles.push_back(std::move(tile));
  }
  for (grid_map_t& message : messages) message.n_tiles = static_cast<std::int32_t>(message.tiles.size());
  return messages;
}

bool GridMapReceiver::restart_if_needed(const grid_map_t& message) {
  const bool same_mapper = started_ && message.session == session_;
  require(!same_mapper || message.epoch >= map_.epoch, "of an older epoch");
  const double resolution_m = std::round(static_cast<double>(message.resolution) * 1e6) / 1e6;
  if (same_mapper && message.epoch == map_.epoch && resolution_m == map_.lattice().pitch_m) return false;
  map_ = GridMap(resolution_m);
  session_ = message.session;
  started_ = true;
  return true;
}

GridMapReceiver::Change GridMapReceiver::apply(const grid_map_t& message) {
  check(message);
  const Pose T_world_body = pose_from_arrays(message.body_pos, message.body_orientation);
  Change change;
  change.restarted = restart_if_needed(message);
  map_.epoch = message.epoch;
  map_.version = std::max(map_.version, message.version);
  if (message.utime >= header_.utime_us || change.restarted)
    header_ = {message.utime, message.step, T_world_body};
  for (const grid_tile_t& tile : message.tiles) {
    const CellIndex index{tile.ix, tile.iy};
    const GridTile* held = map_.find(index);
    if (held != nullptr && held->version > tile.version && tile.side != 0) continue;
    const bool differs = held == nullptr ? tile.side != 0 : tile.side == 0 || held->version != tile.version;
    if (tile.side == 0) {
      map_.erase(index);
    } else {
      take(tile, message.utime, map_.make(index));
    }
    if (differs) change.tiles.push_back(index);
  }
  return change;
}

}  // namespace floornav
