#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

TEST(WorldMap, FlatFloorIsFreeAndTheRestUnknown) {
  const WorldMap map = mapped({see(flat())});
  EXPECT_EQ(count(map, {0, 4, -1, 1}), (Counts{.free = 80 * 40}));
  EXPECT_EQ(count(map, {4, 5, -1, 1}), (Counts{.unknown = 20 * 40}));
  EXPECT_EQ(belief_at(map, 1, 0), 1.0F);
}

TEST(WorldMap, NothingIsFreeBeforeTheFirstFrame) {
  const WorldMap map(MappingSettings{}, RobotSettings{});
  EXPECT_EQ(map.grid().state({0, 0}), VertexState::kUnknown);
  EXPECT_TRUE(map.grid().tiles().empty());
}

TEST(WorldMap, NegativeCoordinatesAreLikeOthers) {
  FloorEvidence frame = see(with_block(flat(), {-2.0, -1.5, -0.25, 0.25}, 0.1), {-4, 0.5, -1, 1});
  const WorldMap map = mapped({frame});
  EXPECT_EQ(count(map, {-2.0, -1.5, -0.25, 0.25}), (Counts{.blocked = 100}));
  EXPECT_EQ(count(map, {-4, 0.5, -1, 1}), (Counts{.free = 90 * 40 - 100, .blocked = 100}));
}

void expect_equal(const GridMap& a, const GridMap& b) {
  ASSERT_EQ(a.sorted_tiles(), b.sorted_tiles());
  for (const CellIndex index : a.sorted_tiles()) {
    EXPECT_EQ(a.find(index)->state, b.find(index)->state);
    EXPECT_EQ(a.find(index)->height, b.find(index)->height);
    EXPECT_EQ(a.find(index)->edges, b.find(index)->edges);
    EXPECT_EQ(a.find(index)->belief, b.find(index)->belief);
    EXPECT_EQ(a.find(index)->sigma, b.find(index)->sigma);
  }
}

std::vector<FloorEvidence> noisy_frames(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, 0.004F);
  std::vector<FloorEvidence> frames;
  for (int i = 0; i < 10; ++i) {
    FloorEvidence frame = see(with_block(ramp(4, 2.5, 3.5), kBox, 0.1), {0.1 * i, 2 + 0.2 * i, -1, 1});
    frame.utime_us += i * 33'000;
    frame.T_world_body.translation().x() = 0.1 * i;
    for (CellEvidence& cell : frame.cells) cell.mean_z_m += noise(random);
    frames.push_back(frame);
  }
  return frames;
}

TEST(WorldMap, SameEvidenceGivesTheSameMap) {
  const auto frames = noisy_frames(3);
  expect_equal(mapped(frames).grid(), mapped(frames).grid());
}

TEST(WorldMap, OrderOfCellsWithinAFrameDoesNotMatter) {
  auto frames = noisy_frames(4);
  const WorldMap sorted = mapped(frames);
  for (FloorEvidence& frame : frames) std::shuffle(frame.cells.begin(), frame.cells.end(), std::mt19937(5));
  expect_equal(sorted.grid(), mapped(frames).grid());
}

TEST(WorldMap, RefreshTellsExactlyTheTilesThatChanged) {
  WorldMap map(MappingSettings{}, RobotSettings{});
  map.integrate(see(flat()));
  const auto first = map.refresh();
  EXPECT_EQ(first, map.grid().sorted_tiles());
  EXPECT_TRUE(map.refresh().empty());
  map.integrate(see(flat(0.3), {2.0, 2.1, 0.5, 0.6}));
  const auto changed = map.refresh();
  EXPECT_EQ(changed, std::vector<CellIndex>{GridMap::tile_of(at(map, 2.05, 0.55))});
  EXPECT_EQ(map.grid().find(changed[0])->version, map.grid().version);
}

TEST(WorldMap, NewEpochForgetsEverything) {
  WorldMap map = mapped({see(flat())});
  map.refresh_terrain();
  map.start_epoch();
  EXPECT_EQ(map.grid().epoch, 1);
  EXPECT_EQ(map.terrain().epoch, 1);
  EXPECT_TRUE(map.grid().tiles().empty());
  EXPECT_TRUE(map.terrain().tiles().empty());
  map.integrate(see(flat()));
  map.refresh();
  EXPECT_EQ(count(map, {}).free, 80 * 40);
}

TEST(WorldMap, ImpossibleCellsAreRefusedAndTheRestTaken) {
  FloorEvidence frame = see(flat(), {0, 1, -1, 1});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  frame.cells[0].mean_z_m = nan;
  frame.cells[1].var_z_m2 = -1;
  frame.cells[2].top_z_m = std::numeric_limits<float>::infinity();
  frame.cells[3].surfel = 4000;
  frame.cells[4].cell = {1'000'000'000, 0};
  frame.cells[5].points = -3;
  frame.surfels[6].normal = Eigen::Vector3f(nan, 0, 1);
  WorldMap map(MappingSettings{}, RobotSettings{});
  const WorldMemory::Taken taken = map.integrate(frame);
  EXPECT_EQ(taken.refused, 7);
  EXPECT_EQ(taken.cells, 20 * 40 - 7);
  map.refresh();
  EXPECT_EQ(count(map, {0, 1, -1, 1}), (Counts{.unknown = 7, .free = 20 * 40 - 7}));
}

TEST(WorldMap, LatticeThatDoesNotDivideTheResolutionIsRefused) {
  MappingSettings settings;
  settings.resolution_m = 0.1;
  WorldMap map(settings, RobotSettings{});
  EXPECT_THROW(map.integrate(see(flat(), {}, 0.04)), std::invalid_argument);
  EXPECT_THROW(map.integrate(see(flat(), {0, 1, 0, 1}, 0.2)), std::invalid_argument);
  FloorEvidence absurd;
  absurd.lattice.pitch_m = 0.001;  // two cells at the ends of such a frame would ask for gigabytes
  EXPECT_THROW(WorldMap({}, {}).integrate(absurd), std::invalid_argument);
  absurd.lattice.pitch_m = std::nan("");
  EXPECT_THROW(map.integrate(absurd), std::invalid_argument);
  map.integrate(see(flat(), {}, 0.05));
  EXPECT_THROW(map.integrate(see(flat(), {}, 0.025)), std::invalid_argument);
}

}  // namespace
}  // namespace floornav
