#include "mapping/node/terrain_map_message.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "mapping/node/map_message_size.hpp"

namespace floornav {
namespace {

TerrainMap random_terrain(int tiles, std::uint32_t seed) {
  std::mt19937 random(seed);
  TerrainMap map(0.2);
  map.version = 40;
  for (int i = 0; i < tiles; ++i) {
    TerrainTile& tile = map.make({-i, i * i});
    tile.origin_z_m = 0.5F;
    for (auto& height : tile.height)
      height = random() % 3 == 0 ? TerrainTile::kUnknown : static_cast<std::int16_t>(random() % 1000);
  }
  return map;
}

terrain_map_t sent(terrain_map_t message) {
  message.source = "mapper";
  message.session = 4;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int size = static_cast<int>(bytes.size());
  EXPECT_EQ(message.encode(bytes.data(), 0, size), size);
  EXPECT_LE(bytes.size(), kMapMessageBytes);
  terrain_map_t received;
  EXPECT_EQ(received.decode(bytes.data(), 0, size), size);
  return received;
}

TEST(TerrainMapMessage, ComesBackAsItWentOut) {
  const TerrainMap map = random_terrain(80, 1);
  TerrainMapReceiver receiver;
  const auto messages = to_messages(map, map.sorted_tiles(), 77);
  EXPECT_GT(messages.size(), 1U);
  for (const terrain_map_t& message : messages) receiver.apply(sent(message));
  ASSERT_EQ(receiver.map().sorted_tiles(), map.sorted_tiles());
  for (const CellIndex index : map.sorted_tiles())
    EXPECT_EQ(receiver.map().find(index)->height, map.find(index)->height);
}

TEST(TerrainMapMessage, FloorTakesHalfAByteACellAndWhatWasNotSeenAlmostNothing) {
  std::mt19937 random(3);
  TerrainMap map(0.2);
  TerrainTile& floor = map.make({0, 0});
  for (auto& height : floor.height) height = static_cast<std::int16_t>(random() % 3);
  map.make({1, 0}).height[5] = 100;
  const auto bytes = [&](CellIndex tile) { return to_messages(map, {tile}, 77)[0].tiles[0].heights.size(); };
  EXPECT_LE(bytes({0, 0}), 32U * 32U / 2U + 8U);
  EXPECT_LE(bytes({1, 0}), 12U);
}

TEST(TerrainMapMessage, HeightIsInMetresAndUnknownIsNan) {
  TerrainMap map(0.2);
  TerrainTile& tile = map.make({-1, 0});
  tile.origin_z_m = 0.5F;
  tile.height[TerrainMap::index_of({-1, 3})] = 250;
  TerrainMapReceiver receiver;
  receiver.apply(sent(to_messages(map, {{-1, 0}}, 77)[0]));
  EXPECT_FLOAT_EQ(receiver.map().height_m({-1, 3}), 0.75F);
  EXPECT_TRUE(std::isnan(receiver.map().height_m({-2, 3})));
  EXPECT_TRUE(std::isnan(receiver.map().height_m({100, 3})));
}

TEST(TerrainMapMessage, CorruptOnesAreRefusedAndNothingChanges) {
  const TerrainMap map = random_terrain(2, 1);
  const terrain_map_t good = sent(to_messages(map, map.sorted_tiles(), 77)[0]);
  TerrainMapReceiver receiver;
  receiver.apply(good);
  const auto refused = [&](auto corrupt) {
    terrain_map_t bad = good;
    bad.epoch = 9;
    corrupt(bad);
    EXPECT_THROW(receiver.apply(bad), std::invalid_argument);
    EXPECT_EQ(receiver.map().epoch, 0);
    EXPECT_EQ(receiver.map().tiles().size(), 2U);
  };
  refused([](terrain_map_t& m) { m.tiles[1].heights.pop_back(); });
  refused([](terrain_map_t& m) { m.tiles[1].heights.clear(); });
  refused([](terrain_map_t& m) { m.tiles[1].heights.push_back(0); });
  refused([](terrain_map_t& m) { m.tiles[1].side = 16; });
  refused([](terrain_map_t& m) { m.tiles[1].ix = std::numeric_limits<std::int32_t>::max(); });
  refused([](terrain_map_t& m) { m.tiles[1].origin_z = std::numeric_limits<float>::quiet_NaN(); });
  refused([](terrain_map_t& m) { m.resolution = 1e9F; });
  refused([](terrain_map_t& m) { m.version = -1; });
}

}  // namespace
}  // namespace floornav
