#include <algorithm>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

class BoxTop : public testing::TestWithParam<double> {};

TEST_P(BoxTop, FlatButOutOfReachIsBlocked) {
  const WorldMap map = mapped({see(with_block(flat(), kBox, GetParam()))});
  EXPECT_EQ(count(map, kBox), (Counts{.blocked = 100}));
  EXPECT_EQ(count(map, {}), (Counts{.free = 80 * 40 - 100, .blocked = 100}));
  EXPECT_NEAR(height_at(map, 1.75, 0), GetParam(), 1e-4);
  EXPECT_NEAR(belief_at(map, 1.75, 0), std::max(0.0, 1 - GetParam() / 0.75), 0.003);
}

TEST_P(BoxTop, IsBlockedWhereOnlyItsFrontIsSeen) {
  const double shadow_m = 2.0 + 0.5 * GetParam();
  const Scene scene = with_hole(with_block(flat(), kBox, GetParam()), {2.0, shadow_m, -0.25, 0.25});
  const WorldMap map = mapped({see(scene, {0, 2.5, -0.25, 0.25})});
  EXPECT_EQ(count(map, kBox), (Counts{.blocked = 100}));
}

INSTANTIATE_TEST_SUITE_P(Heights, BoxTop, testing::Values(0.025, 0.03, 0.05, 0.1, 0.3, 0.6, 0.74));

TEST(WorldMap, HigherThanTheRobotDoesNotBlock) {
  FloorEvidence frame = see(flat());
  const FloorEvidence lamp = see(flat(1.2), kBox);
  frame.surfels.insert(frame.surfels.end(), lamp.surfels.begin(), lamp.surfels.end());
  for (CellEvidence cell : lamp.cells) {
    cell.surfel = static_cast<std::int16_t>(cell.surfel + 80 * 40);
    frame.cells.push_back(cell);
  }
  const WorldMap map = mapped({frame});
  EXPECT_EQ(count(map, {}), (Counts{.free = 80 * 40}));
  const CellIndex below = at(map, 1.75, 0);
  EXPECT_EQ(tile_at(map, below).clearance[GridMap::index_of(below)], 120);
  const CellIndex beside = at(map, 1.0, 0);
  EXPECT_EQ(tile_at(map, beside).clearance[GridMap::index_of(beside)], GridTile::kNothingAbove);
}

TEST(WorldMap, WallIsBlockedAndAsHighAsItsTop) {
  FloorEvidence frame = see(flat());
  Surfel wall;
  wall.centroid_m = Eigen::Vector3d(2, 0, 0.3);
  wall.normal = Eigen::Vector3f(-1, 0, 0);
  frame.surfels.push_back(wall);
  for (CellEvidence& cell : frame.cells) {
    if (cell.cell.ix != 40) continue;
    cell.surfel = static_cast<std::int16_t>(frame.surfels.size() - 1);
    cell.mean_z_m = 0.3F;
    cell.top_z_m = 0.7F;
  }
  const WorldMap map = mapped({frame});
  EXPECT_EQ(count(map, {2.0, 2.05, -1, 1}), (Counts{.blocked = 40}));
  EXPECT_EQ(count(map, {2.05, 2.1, -1, 1}), (Counts{.unknown = 40}));  // nobody sees through a wall
  EXPECT_EQ(count(map, {}), (Counts{.unknown = 40, .free = 78 * 40, .blocked = 40}));
  EXPECT_NEAR(height_at(map, 2.02, 0), 0.7, 1e-4);
  EXPECT_EQ(belief_at(map, 2.02, 0), 0);
}

TEST(WorldMap, PointsOnNoSurfelAreBlocked) {
  FloorEvidence frame = see(flat());
  for (CellEvidence& cell : frame.cells)
    if (cell.cell == CellIndex{40, 0}) cell.surfel = -1;
  const WorldMap map = mapped({frame});
  EXPECT_EQ(map.grid().state({40, 0}), VertexState::kBlocked);
  EXPECT_EQ(count(map, {}).free, 80 * 40 - 1);
}

TEST(WorldMap, PoleThatStandsOutOfAFloorCellBlocks) {
  FloorEvidence frame = see(flat());
  for (CellEvidence& cell : frame.cells)
    if (cell.cell == CellIndex{40, 0}) cell.top_z_m = 0.4F;
  const WorldMap map = mapped({frame});
  EXPECT_EQ(map.grid().state({40, 0}), VertexState::kBlocked);
  EXPECT_NEAR(height_at(map, 2.01, 0.01), 0.4, 1e-4);
}

TEST(WorldMap, FloorThroughWhichAnEdgeGoesIsBlockedAloneAndKeepsItsHeight) {
  FloorEvidence frame = see(flat(0.004));
  for (CellEvidence& cell : frame.cells) cell.on_edge = cell.cell == CellIndex{40, 0};
  const WorldMap map = mapped({frame, frame});
  EXPECT_EQ(count(map, {}), (Counts{.free = 80 * 40 - 1, .blocked = 1}));
  EXPECT_EQ(map.grid().state({40, 0}), VertexState::kBlocked);
  EXPECT_NEAR(height_at(map, 2.025, 0.025), 0.004, 1e-3);
}

TEST(WorldMap, CellOnTheEdgeOfABoxInsideACoarseVertexBlocksIt) {
  MappingSettings settings;
  settings.resolution_m = 0.3;
  settings.terrain_resolution_m = 0.3;
  const WorldMap map =
      mapped({see(with_block(flat(), {1.75, 1.8, 0.0, 0.05}, 0.1), {0, 3, -0.9, 0.9})}, settings);
  EXPECT_EQ(map.grid().state({5, 0}), VertexState::kBlocked);
  EXPECT_EQ(count(map, {0, 3, -0.9, 0.9}).blocked, 1);
  EXPECT_NEAR(height_at(map, 1.6, 0.1), 0.1, 1e-4);
}

}  // namespace
}  // namespace floornav
