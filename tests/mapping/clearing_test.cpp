#include <vector>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

TEST(WorldMap, BoxThatLeavesIsFreeFloorAgain) {
  std::vector<FloorEvidence> frames(20, see(with_block(flat(), kBox, 0.3)));
  EXPECT_EQ(count(mapped(frames), kBox).blocked, 100);
  frames.insert(frames.end(), 12, see(flat()));
  EXPECT_EQ(count(mapped(frames), {}), (Counts{.free = 80 * 40}));
}

TEST(WorldMap, SightLinesUnderARememberedTopClearItToUnknown) {
  std::vector<FloorEvidence> frames(20, see(with_block(flat(), kBox, 0.3)));
  FloorEvidence empty = see(with_hole(flat(), kBox));
  for (std::int32_t ix = 30; ix < 40; ++ix) {
    for (std::int32_t iy = -5; iy < 5; ++iy) {
      CellEvidence ray;
      ray.cell = {ix, iy};
      ray.ray_z_m = 0.15F;
      empty.cells.push_back(ray);
    }
  }
  frames.insert(frames.end(), 12, empty);
  EXPECT_EQ(count(mapped(frames), kBox), (Counts{.unknown = 100}));
}

TEST(WorldMap, WhatIsNotSeenAgainStays) {
  std::vector<FloorEvidence> frames{see(with_block(flat(), kBox, 0.3))};
  frames.insert(frames.end(), 50, see(flat(), {0, 1.4, -1, 1}));
  EXPECT_EQ(count(mapped(frames), kBox).blocked, 100);
}

TEST(WorldMap, DoorThatClosesLeavesTheFloorBehindItFree) {
  const Area door{2.0, 2.1, -2, 2};
  std::vector<FloorEvidence> frames{see(flat()), see(with_block(flat(), door, 0.7), {0, 2.1, -1, 1})};
  const WorldMap map = mapped(frames);
  EXPECT_EQ(count(map, {2.0, 2.1, -1, 1}).blocked, 80);
  EXPECT_EQ(count(map, {2.1, 4, -1, 1}).free, 38 * 40);
}

}  // namespace
}  // namespace floornav
