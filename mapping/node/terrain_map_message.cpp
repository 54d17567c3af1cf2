#include "mapping/node/terrain_map_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lcmtypes/depth_codec.hpp"
#include "mapping/node/map_message_size.hpp"

namespace floornav {
namespace {

constexpr std::int32_t kZeroHeight = 32768;
static_assert(TerrainTile::kUnknown + kZeroHeight == 0);
using Codes = std::array<std::uint16_t, TerrainTile::kCells>;

terrain_tile_t to_message(CellIndex index, const TerrainTile& tile) {
  terrain_tile_t message{};
  message.ix = index.ix;
  message.iy = index.iy;
  message.origin_z = tile.origin_z_m;
  message.side = TerrainTile::kSide;
  Codes codes;
  std::ranges::transform(tile.height, codes.begin(), [](std::int16_t height) {
    return static_cast<std::uint16_t>(height + kZeroHeight);
  });
  encode_rvl(codes, message.heights);
  message.n_bytes = static_cast<std::int32_t>(message.heights.size());
  return message;
}

terrain_map_t without_tiles(const TerrainMap& map, std::int64_t utime_us) {
  terrain_map_t message{};
  message.utime = utime_us;
  message.epoch = map.epoch;
  message.version = map.version;
  message.resolution = static_cast<float>(map.lattice().pitch_m);
  return message;
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("terrain map: ") + what);
}

TerrainTile unpacked(const terrain_tile_t& message, std::int64_t version) {
  TerrainTile tile;
  tile.version = version;
  tile.origin_z_m = message.origin_z;
  Codes codes;
  try {
    decode_rvl(message.heights, codes);
  } catch (const CorruptDepth& error) {
    require(false, error.what());
  }
  std::ranges::transform(codes, tile.height.begin(), [](std::uint16_t code) {
    return static_cast<std::int16_t>(static_cast<std::int32_t>(code) - kZeroHeight);
  });
  return tile;
}

void check(const terrain_map_t& message) {
  constexpr std::int64_t kFarthestTile = std::numeric_limits<std::int32_t>::max() / TerrainTile::kSide - 1;
  require(message.utime >= 0 && message.epoch >= 0 && message.version >= 0,
          "negative time, epoch or version");
  require(std::isfinite(message.resolution) && message.resolution >= 0.001F && message.resolution <= 10.0F,
          "absurd resolution");
  for (const terrain_tile_t& tile : message.tiles) {
    require(
        std::abs(std::int64_t{tile.ix}) <= kFarthestTile && std::abs(std::int64_t{tile.iy}) <= kFarthestTile,
        "tile index out of range");
    require(tile.side == TerrainTile::kSide, "tile of another size");
    require(std::isfinite(tile.origin_z), "height that is not finite");
  }
}

}  // namespace

std::vector<terrain_map_t> to_messages(const TerrainMap& map, const std::vector<CellIndex>& tiles,
                                       std::int64_t utime_us) {
  std::vector<terrain_map_t> messages;
  MessageSize size(static_cast<std::size_t>(without_tiles(map, utime_us).getEncodedSize()));
  for (const CellIndex index : tiles) {
    const TerrainTile* tile = map.find(index);
    if (tile == nullptr) continue;
    terrain_tile_t part = to_message(index, *tile);
    if (size.needs_new_message(static_cast<std::size_t>(part.getEncodedSize())) || messages.empty())
      messages.push_back(without_tiles(map, utime_us));
    messages.back().tiles.push_back(std::move(part));
  }
  for (terrain_map_t& message : messages) message.n_tiles = static_cast<std::int32_t>(message.tiles.size());
  return messages;
}

void TerrainMapReceiver::apply(const terrain_map_t& message) {
  check(message);
  std::vector<TerrainTile> tiles;
  for (const terrain_tile_t& part : message.tiles) tiles.push_back(unpacked(part, message.version));
  const bool same_mapper = started_ && message.session == session_;
  require(!same_mapper || message.epoch >= map_.epoch, "of an older epoch");
  const double resolution_m = std::round(static_cast<double>(message.resolution) * 1e6) / 1e6;
  if (!same_mapper || message.epoch != map_.epoch || resolution_m != map_.lattice().pitch_m)
    map_ = TerrainMap(resolution_m);
  session_ = message.session;
  started_ = true;
  map_.epoch = message.epoch;
  map_.version = std::max(map_.version, message.version);
  for (std::size_t i = 0; i < tiles.size(); ++i)
    map_.make({message.tiles[i].ix, message.tiles[i].iy}) = tiles[i];
}

}  // namespace floornav
