#include "mapping/map_memory.hpp"

#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "mapping/moved_memory.hpp"
#include "mapping/tile_codec.hpp"
#include "mapping/world_map.hpp"
#include "tests/mapping/made_evidence.hpp"

namespace floornav {
namespace {

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

/// Floor with a box, seen from the origin a few times.
WorldMap room(const MappingSettings& settings = {}) {
  WorldMap map(settings, RobotSettings{});
  for (int i = 1; i <= 5; ++i) {
    FloorEvidence frame = see(with_block(flat(), kBox, 0.3), {}, 0.05);
    frame.utime_us = i * 100'000;
    map.integrate(frame);
    map.refresh();
  }
  return map;
}

void expect_same_map(const GridMap& a, const GridMap& b) {
  ASSERT_EQ(a.sorted_tiles(), b.sorted_tiles());
  for (const CellIndex index : a.sorted_tiles()) {
    EXPECT_EQ(a.find(index)->state, b.find(index)->state);
    EXPECT_EQ(a.find(index)->edges, b.find(index)->edges);
    EXPECT_EQ(a.find(index)->belief, b.find(index)->belief);
    EXPECT_EQ(a.find(index)->clearance, b.find(index)->clearance);
    EXPECT_EQ(a.find(index)->seen, b.find(index)->seen);
    for (std::int32_t i = 0; i < GridTile::kVertices; ++i)
      ASSERT_NEAR(a.find(index)->height_m(i), b.find(index)->height_m(i), 0.0011);
  }
}

Level random_level(std::mt19937& random) {
  std::uniform_real_distribution<float> z(-1, 2);
  Level level;
  level.z_m = z(random);
  level.var_m2 = 1e-6F * static_cast<float>(1 + random() % 1000);
  level.gradient_x = 0.1F * z(random);
  level.gradient_y = 0.1F * z(random);
  level.column = random() % 4 == 0;
  level.support = static_cast<std::uint8_t>(1 + random() % Level::kMost);
  const int reach = static_cast<int>(random() % (2 * Surface::kCorner + 1)) - Surface::kCorner;
  level.reach = static_cast<std::int8_t>(level.column ? 0 : reach);
  return level;
}

class RandomTiles : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomTiles, testing::Range(1U, 9U));

TEST_P(RandomTiles, ComeBackToWithinTheUnitsOfThePackingAndPackTheSameAgain) {
  std::mt19937 random(GetParam());
  MapTile tile;
  tile.cells = CellStore(GridTile::kVertices, 0);
  for (std::size_t i = 0; i < tile.cells.size(); ++i) {
    if (random() % 3 == 0) continue;
    const Level upper = random() % 4 == 0 ? random_level(random) : Level{};
    const float overhead_m = random() % 5 == 0 ? 1.2F : std::numeric_limits<float>::quiet_NaN();
    const auto floor_doubt = static_cast<std::int32_t>(random() % 4);
    tile.cells.set(i, {random_level(random), upper, overhead_m, floor_doubt});
    tile.seen().set(i, static_cast<std::uint32_t>(random() % 5));
    tile.vertices[i].set(Vertex::kFloor, random() % 2 == 0);
  }
  const std::vector<std::uint8_t> bytes = pack(tile);
  MapTile back;
  unpack(bytes, tile.cells.size(), back);
  for (std::size_t i = 0; i < tile.cells.size(); ++i) {
    const CellMemory cell_before = tile.cells.at(i);
    const CellMemory cell_after = back.cells.at(i);
    for (const auto level : {&CellMemory::lower, &CellMemory::upper}) {
      const Level& before = (cell_before.*level)();
      const Level& after = (cell_after.*level)();
      ASSERT_EQ(after.support, before.support);
      ASSERT_EQ(after.column, before.column);
      ASSERT_EQ(after.reach, before.reach);
      ASSERT_NEAR(after.z_m, before.z_m, 0.51e-4);
      ASSERT_NEAR(after.gradient_x, before.gradient_x, 0.51 / 1024);  // the store's own units are finer
      ASSERT_NEAR(after.gradient_y, before.gradient_y, 0.51 / 1024);
      if (before.exists()) {
        ASSERT_NEAR(after.var_m2 / before.var_m2, 1, 0.08);
      }
    }
    ASSERT_EQ(std::isnan(cell_after.overhead_z_m()), std::isnan(cell_before.overhead_z_m()));
    ASSERT_EQ(cell_after.floor_doubt(), cell_before.floor_doubt());
    ASSERT_EQ(back.seen()[i], tile.seen()[i]);
    ASSERT_EQ(back.vertices[i].is(Vertex::kFloor), tile.vertices[i].is(Vertex::kFloor));
  }
  EXPECT_EQ(pack(back), bytes);
}

TEST_P(RandomTiles, BytesThatAreNoTileAreRefusedOrReadButNeverHarm) {
  std::mt19937 random(GetParam());
  const std::vector<std::uint8_t> good = room().memory().tiles.front().second;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<std::uint8_t> bytes = good;
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (trial % 4 == 0) bytes.resize(random() % bytes.size());
    MapTile tile;
    try {
      unpack(bytes, GridTile::kVertices, tile);
    } catch (const std::invalid_argument&) {
    }
  }
}

TEST(MapMemory, ARestoredMapIsJudgedAsItWas) {
  const WorldMap before = room();
  WorldMap after(MappingSettings{}, RobotSettings{});
  after.restore(memory_from_bytes(to_bytes(before.memory())));
  expect_same_map(after.grid(), before.grid());
  EXPECT_EQ(after.utime_us(), before.utime_us());
  EXPECT_EQ(after.grid().epoch, 1);
}

TEST(MapMemory, AnotherRobotJudgesTheSameMapByItsOwnLimits) {
  WorldMap seen(MappingSettings{}, RobotSettings{});
  for (int i = 0; i < 5; ++i) {
    seen.integrate(see(with_block(flat(), kBox, 0.04)));
    seen.refresh();
  }
  const CellIndex on_box = seen.grid().lattice().cell_of(1.75, 0);
  EXPECT_EQ(seen.grid().state(on_box), VertexState::kBlocked);
  RobotSettings climber;
  climber.max_step_m = 0.06;
  climber.ground_clearance_m = 0.08;
  WorldMap other(MappingSettings{}, climber);
  other.restore(seen.memory());
  EXPECT_EQ(other.grid().state(on_box), VertexState::kFree);
}

TEST(MapMemory, AMapOfAnotherResolutionIsRefusedAndNothingChanges) {
  MappingSettings coarse;
  coarse.resolution_m = 0.1;
  WorldMap map = room(coarse);
  const GridMap& grid = map.grid();
  const std::int64_t version = grid.version;
  EXPECT_THROW(map.restore(room().memory()), std::invalid_argument);
  EXPECT_EQ(grid.version, version);
  EXPECT_FALSE(grid.sorted_tiles().empty());
}

TEST(MapMemory, EveryDamageIsTold) {
  const std::vector<std::uint8_t> good = to_bytes(room().memory());
  for (std::size_t i = 0; i < good.size(); i += 1 + i / 64) {
    std::vector<std::uint8_t> bad = good;
    bad[i] ^= 0x10U;
    EXPECT_THROW((void)memory_from_bytes(bad), std::invalid_argument) << "byte " << i;
    bad = good;
    bad.resize(i);
    EXPECT_THROW((void)memory_from_bytes(bad), std::invalid_argument) << "first " << i;
  }
  std::vector<std::uint8_t> longer = good;
  longer.push_back(0);
  EXPECT_THROW((void)memory_from_bytes(longer), std::invalid_argument);
}

TEST(MapMemory, WhatTheRobotLeavesBehindIsPackedAndComesBackUnchanged) {
  WorldMap map = room();
  const auto at = [&](CellIndex index) { return *map.grid().find(index); };
  const std::vector<CellIndex> tiles = map.grid().sorted_tiles();
  std::vector<GridTile> before;
  for (const CellIndex index : tiles) before.push_back(at(index));
  const auto drive_to = [&](double x_m, std::int64_t utime_us) {
    FloorEvidence frame = see(flat(), {x_m, x_m + 2, 3, 4});
    frame.T_world_body.translation().x() = x_m;
    frame.utime_us = utime_us;
    map.integrate(frame);
    map.refresh();
    map.refresh_terrain();
  };
  const std::int64_t awake_bytes = map.memory_bytes();
  for (int i = 0; i < 15; ++i) drive_to(2.0 * i, 1'000'000 + i * 100'000);
  EXPECT_LT(map.memory_bytes(), awake_bytes + 15 * 5 * 100'000);
  for (int i = 14; i >= 3; --i) drive_to(2.0 * i, 4'000'000 - i * 100'000);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    EXPECT_EQ(at(tiles[i]).state, before[i].state);
    EXPECT_EQ(at(tiles[i]).seen, before[i].seen);
    if (tiles[i].ix > 0 && tiles[i].iy < 0) {
      EXPECT_EQ(at(tiles[i]).edges, before[i].edges);
    }
  }
  EXPECT_EQ(map.grid().state(map.grid().lattice().cell_of(1.75, 0)), VertexState::kBlocked);
  EXPECT_TRUE(std::isfinite(map.terrain().height_m(map.terrain().lattice().cell_of(1.75, 0))));
}

TEST(MapMemory, ASquareMetreNearTheRobotTakesLessThan8Kilobytes) {
  constexpr double kSide_m = 3 * 1.6;  // whole tiles
  WorldMap map(MappingSettings{}, RobotSettings{});
  for (int i = 0; i < 3; ++i) {
    map.integrate(see(flat(), {0, kSide_m, 0, kSide_m}));
    map.refresh();
    map.refresh_terrain();
  }
  EXPECT_LT(static_cast<double>(map.memory_bytes()), 8000 * kSide_m * kSide_m);
}

TEST(MapMemory, APathLeadsAcrossTheBorderOfWhatIsPacked) {
  WorldMap map(MappingSettings{}, RobotSettings{});
  for (int i = 0; i < 40; ++i) {
    const int at = i < 20 ? i : 39 - i;  // there and back
    FloorEvidence frame = see(flat(), {2.0 * at - 0.5, 2.0 * at + 2.5, -0.5, 0.5});
    frame.T_world_body.translation().x() = 2.0 * at;
    frame.utime_us = 1'000'000 + i * 100'000;
    map.integrate(frame);
    map.refresh();
    map.refresh_terrain();
    for (double x_m = 0; x_m < 2.0 * at + 2; x_m += 0.05) {
      const CellIndex cell = map.grid().lattice().cell_of(x_m, 0);
      const GridTile* const tile = map.grid().find(GridMap::tile_of(cell));
      ASSERT_EQ(tile->edges[static_cast<std::size_t>(GridTile::index_of(cell))], 0xFF)
          << "frame " << i << " x " << x_m;
    }
  }
}

class MovedMaps : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Degrees, MovedMaps, testing::Values(0.0, 90.0, 30.0, -137.0));

TEST_P(MovedMaps, LieWhereTheTransformPutsThem) {
  const double turn = GetParam() * std::numbers::pi / 180;
  const Pose T_new_old =
      Eigen::Translation3d(12.3, -4.56, 0.2) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  WorldMap map(MappingSettings{}, RobotSettings{});
  map.restore(moved(room().memory(), T_new_old));
  const auto state_at = [&](double x_m, double y_m) {
    const Eigen::Vector3d at = T_new_old * Eigen::Vector3d(x_m, y_m, 0);
    return map.grid().state(map.grid().lattice().cell_of(at.x(), at.y()));
  };
  EXPECT_EQ(state_at(1.75, 0), VertexState::kBlocked);
  EXPECT_EQ(state_at(1.55, 0.2), VertexState::kBlocked);
  EXPECT_EQ(state_at(-0.2, 0), VertexState::kUnknown);
  int free = 0;
  int places = 0;
  for (double x_m = 0.1; x_m < 3.9; x_m += 0.05) {
    for (double y_m = 0.4; y_m < 0.9; y_m += 0.05, ++places) {
      free += state_at(x_m, y_m) == VertexState::kFree ? 1 : 0;
      const Eigen::Vector3d at = T_new_old * Eigen::Vector3d(x_m, y_m, 0);
      const CellIndex cell = map.grid().lattice().cell_of(at.x(), at.y());
      ASSERT_NEAR(map.grid().find(GridMap::tile_of(cell))->height_m(GridTile::index_of(cell)), 0.2, 0.002);
    }
  }
  EXPECT_EQ(free, places);
}

}  // namespace
}  // namespace floornav
