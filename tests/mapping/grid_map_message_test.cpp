#include "mapping/node/grid_map_message.hpp"

#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "mapping/node/map_message_size.hpp"

namespace floornav {
namespace {

constexpr std::int64_t kNow_us = 1'300'000'000'000'000;

void fill(GridTile& tile, std::int64_t version, std::mt19937& random) {
  tile.version = version;
  tile.origin_z_m = 0.125F;
  for (std::size_t i = 0; i < GridTile::kVertices; ++i) {
    tile.state[i] = static_cast<VertexState>(random() % 3);
    tile.belief[i] = static_cast<std::uint8_t>(random());
    tile.height[i] = static_cast<std::int16_t>(random());
    tile.sigma[i] = sigma_code(static_cast<std::int16_t>(random() % 1000));
    tile.slope[i] = static_cast<std::uint8_t>(random());
    tile.clearance.set(i, static_cast<std::uint8_t>(random()));
    tile.edges[i] = static_cast<std::uint8_t>(random());
    const std::uint32_t age = static_cast<std::uint32_t>(random() % 30000);
    tile.seen.set(i, random() % 4 == 0 ? 0 : GridTile::Seen::at(kNow_us) - age);
  }
}

GridMap random_map(int tiles, std::uint32_t seed) {
  std::mt19937 random(seed);
  GridMap map(0.05);
  map.epoch = 2;
  map.version = 1000;
  for (int i = 0; i < tiles; ++i) fill(map.make({i % 7 - 3, i / 7 - 5}), 1 + i, random);
  return map;
}

/// As over the wire: encoded, decoded, with a sender.
grid_map_t sent(grid_map_t message, std::int64_t session = 11) {
  message.source = "mapper";
  message.session = session;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int size = static_cast<int>(bytes.size());
  EXPECT_EQ(message.encode(bytes.data(), 0, size), size);
  EXPECT_LE(bytes.size(), kMapMessageBytes);
  grid_map_t received;
  EXPECT_EQ(received.decode(bytes.data(), 0, size), size);
  return received;
}

void expect_equal(const GridMap& a, const GridMap& b) {
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.lattice().pitch_m, b.lattice().pitch_m);
  ASSERT_EQ(a.sorted_tiles(), b.sorted_tiles());
  for (const CellIndex index : a.sorted_tiles()) {
    const GridTile& x = *a.find(index);
    const GridTile& y = *b.find(index);
    EXPECT_EQ(x.version, y.version);
    EXPECT_EQ(x.origin_z_m, y.origin_z_m);
    EXPECT_EQ(x.state, y.state);
    EXPECT_EQ(x.belief, y.belief);
    EXPECT_EQ(x.height, y.height);
    EXPECT_EQ(x.sigma, y.sigma);
    EXPECT_EQ(x.slope, y.slope);
    EXPECT_EQ(x.clearance, y.clearance);
    EXPECT_EQ(x.edges, y.edges);
    EXPECT_EQ(x.seen, y.seen);
  }
}

GridMapHeader header() {
  GridMapHeader header;
  header.utime_us = kNow_us;
  header.step_m = 0.02F;
  header.T_world_body.translation() = Eigen::Vector3d(1, -2, 0.5);
  return header;
}

TEST(GridMapMessage, ComesBackAsItWentOut) {
  const GridMap map = random_map(23, 1);
  GridMapReceiver receiver;
  for (const grid_map_t& message : to_messages(map, map.sorted_tiles(), header()))
    receiver.apply(sent(message));
  expect_equal(map, receiver.map());
  EXPECT_EQ(receiver.header().utime_us, kNow_us);
  EXPECT_EQ(receiver.header().step_m, 0.02F);
  EXPECT_TRUE(receiver.header().T_world_body.isApprox(header().T_world_body));
}

TEST(GridMapMessage, ComesEvenWithoutTiles) {
  const auto messages = to_messages(GridMap(0.1), {}, header());
  ASSERT_EQ(messages.size(), 1U);
  GridMapReceiver receiver;
  EXPECT_FALSE(receiver.started());
  EXPECT_TRUE(receiver.apply(sent(messages[0])).restarted);
  EXPECT_TRUE(receiver.started());
  EXPECT_EQ(receiver.map().lattice().pitch_m, 0.1);
}

class LossyChannel : public testing::TestWithParam<std::uint32_t> {};

TEST_P(LossyChannel, RepeatedTilesMendTheReceiver) {
  std::mt19937 random(GetParam());
  GridMap map = random_map(40, GetParam());
  GridMapReceiver receiver;
  for (int round = 0; round < 8; ++round) {
    for (int i = 0; i < 5; ++i) {
      const auto tiles = map.sorted_tiles();
      fill(map.make(tiles[random() % tiles.size()]), ++map.version, random);
    }
    for (const grid_map_t& message : to_messages(map, map.sorted_tiles(), header()))
      if (random() % 10 != 0) receiver.apply(sent(message));
  }
  for (int repeat = 0; repeat < 6; ++repeat)
    for (const grid_map_t& message : to_messages(map, map.sorted_tiles(), header()))
      if (random() % 10 != 0) receiver.apply(sent(message));
  expect_equal(map, receiver.map());
}

TEST_P(LossyChannel, LateOlderTileDoesNotReplaceANewerOne) {
  std::mt19937 random(GetParam());
  GridMap map = random_map(3, GetParam());
  const auto old = to_messages(map, map.sorted_tiles(), header());
  map.version = 2000;
  for (const CellIndex index : map.sorted_tiles()) fill(map.make(index), map.version, random);
  GridMapReceiver receiver;
  for (const grid_map_t& message : to_messages(map, map.sorted_tiles(), header()))
    receiver.apply(sent(message));
  for (const grid_map_t& message : old) EXPECT_TRUE(receiver.apply(sent(message)).tiles.empty());
  expect_equal(map, receiver.map());
  EXPECT_EQ(receiver.map().version, 2000);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LossyChannel, testing::Range(1U, 6U));

TEST(GridMapMessage, TellsOnlyTilesThatDiffer) {
  GridMap map = random_map(3, 5);
  GridMapReceiver receiver;
  const auto first = receiver.apply(sent(to_messages(map, map.sorted_tiles(), header())[0]));
  EXPECT_TRUE(first.restarted);
  EXPECT_EQ(first.tiles, map.sorted_tiles());
  std::mt19937 random(3);
  const CellIndex changed = map.sorted_tiles()[1];
  fill(map.make(changed), ++map.version, random);
  const auto second = receiver.apply(sent(to_messages(map, map.sorted_tiles(), header())[0]));
  EXPECT_FALSE(second.restarted);
  EXPECT_EQ(second.tiles, std::vector<CellIndex>{changed});
}

TEST(GridMapMessage, ForgottenTileIsForgotten) {
  GridMap map = random_map(2, 5);
  GridMapReceiver receiver;
  const auto tiles = map.sorted_tiles();
  receiver.apply(sent(to_messages(map, tiles, header())[0]));
  map.erase(tiles[0]);
  EXPECT_EQ(receiver.apply(sent(to_messages(map, tiles, header())[0])).tiles,
            std::vector<CellIndex>{tiles[0]});
  expect_equal(map, receiver.map());
}

TEST(GridMapMessage, NewEpochSessionOrResolutionStartsAnew) {
  GridMap map = random_map(2, 5);
  GridMapReceiver receiver;
  receiver.apply(sent(to_messages(map, map.sorted_tiles(), header())[0]));
  map.epoch = 3;
  EXPECT_TRUE(receiver.apply(sent(to_messages(map, {}, header())[0])).restarted);
  EXPECT_TRUE(receiver.map().tiles().empty());

  receiver.apply(sent(to_messages(map, map.sorted_tiles(), header())[0]));
  map.epoch = 0;  // a mapper that started again
  EXPECT_TRUE(receiver.apply(sent(to_messages(map, {}, header())[0], 12)).restarted);
  EXPECT_TRUE(receiver.map().tiles().empty());
  EXPECT_EQ(receiver.map().epoch, 0);

  GridMap coarse(0.3);
  EXPECT_TRUE(receiver.apply(sent(to_messages(coarse, {}, header())[0], 12)).restarted);
  EXPECT_EQ(receiver.map().lattice().pitch_m, 0.3);
}

TEST(GridMapMessage, OlderEpochIsRefused) {
  GridMap map = random_map(1, 5);
  GridMapReceiver receiver;
  receiver.apply(sent(to_messages(map, map.sorted_tiles(), header())[0]));
  map.epoch = 1;
  EXPECT_THROW(receiver.apply(sent(to_messages(map, {}, header())[0])), std::invalid_argument);
  EXPECT_EQ(receiver.map().epoch, 2);
  EXPECT_EQ(receiver.map().tiles().size(), 1U);
}

struct Corruption {
  const char* name;
  std::function<void(grid_map_t&)> apply;
};

class CorruptGridMap : public testing::TestWithParam<Corruption> {};

TEST_P(CorruptGridMap, IsRefusedAndNothingChanges) {
  const GridMap map = random_map(3, 9);
  GridMapReceiver receiver;
  receiver.apply(sent(to_messages(map, map.sorted_tiles(), header())[0]));
  GridMap other = random_map(4, 10);
  other.epoch = 5;
  grid_map_t message = sent(to_messages(other, other.sorted_tiles(), header())[0]);
  GetParam().apply(message);
  EXPECT_THROW(receiver.apply(message), std::invalid_argument);
  expect_equal(map, receiver.map());
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Kinds, CorruptGridMap,
    testing::Values(
        Corruption{"State", [](grid_map_t& m) { m.tiles[3].state[7] = 3; }},
        Corruption{"ShortArray", [](grid_map_t& m) { m.tiles[3].height.pop_back(); }},
        Corruption{"LongArray", [](grid_map_t& m) { m.tiles[0].age.push_back(0); }},
        Corruption{"Side", [](grid_map_t& m) { m.tiles[1].side = 31; }},
        Corruption{"Count", [](grid_map_t& m) { m.tiles[1].count = 0; }},
        Corruption{"CountOfEmpty", [](grid_map_t& m) { m.tiles[1].side = 0; }},
        Corruption{"FarTile",
                   [](grid_map_t& m) { m.tiles[2].ix = std::numeric_limits<std::int32_t>::min(); }},
        Corruption{"FutureTile", [](grid_map_t& m) { m.tiles[2].version = m.version + 1; }},
        Corruption{"OriginZ",
                   [](grid_map_t& m) { m.tiles[2].origin_z = std::numeric_limits<float>::infinity(); }},
        Corruption{"Resolution", [](grid_map_t& m) { m.resolution = 0; }},
        Corruption{"ResolutionNan", [](grid_map_t& m) { m.resolution = static_cast<float>(kNan); }},
        Corruption{"Step", [](grid_map_t& m) { m.step = -1; }},
        Corruption{"Epoch", [](grid_map_t& m) { m.epoch = -1; }},
        Corruption{"Version", [](grid_map_t& m) { m.version = -5; }},
        Corruption{"Utime", [](grid_map_t& m) { m.utime = -5; }},
        Corruption{"Position", [](grid_map_t& m) { m.body_pos[1] = kNan; }},
        Corruption{"Orientation",
                   [](grid_map_t& m) {
                     for (double& q : m.body_orientation) q = 0;
                   }}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace floornav
