#include "mapping/world_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "tests/mapping/made_evidence.hpp"

namespace floornav {
namespace {

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

WorldMap mapped(const std::vector<FloorEvidence>& frames, MappingSettings settings = {},
                RobotSettings robot = {}) {
  WorldMap map(settings, robot);
  for (const FloorEvidence& frame : frames) {
    map.integrate(frame);
    map.refresh();
  }
  return map;
}

struct Counts {
  int unknown = 0;
  int free = 0;
  int blocked = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
};

/// Vertices whose centres lie in the area.
template <class Visit>
void for_each_vertex(const WorldMap& map, const Area& area, Visit visit) {
  const Lattice& lattice = map.grid().lattice();
  for (std::int32_t iy = lattice.index_of(area.y_min_m) - 1; iy <= lattice.index_of(area.y_max_m) + 1; ++iy)
    for (std::int32_t ix = lattice.index_of(area.x_min_m) - 1; ix <= lattice.index_of(area.x_max_m) + 1; ++ix)
      if (inside(lattice.center_of(ix), lattice.center_of(iy), area)) visit(CellIndex{ix, iy});
}

Counts count(const WorldMap& map, const Area& area) {
  Counts counts;
  for_each_vertex(map, area, [&](CellIndex vertex) {
    const VertexState state = map.grid().state(vertex);
    ++(state == VertexState::kUnknown ? counts.unknown
       : state == VertexState::kFree  ? counts.free
                                      : counts.blocked);
  });
  return counts;
}

CellIndex at(const WorldMap& map, double x_m, double y_m) {
  return map.grid().lattice().cell_of(x_m, y_m);
}

const GridTile& tile_at(const WorldMap& map, CellIndex vertex) {
  return *map.grid().find(GridMap::tile_of(vertex));
}

float height_at(const WorldMap& map, double x_m, double y_m) {
  const CellIndex vertex = at(map, x_m, y_m);
  return tile_at(map, vertex).height_m(GridTile::index_of(vertex));
}

float belief_at(const WorldMap& map, double x_m, double y_m) {
  const CellIndex vertex = at(map, x_m, y_m);
  return static_cast<float>(tile_at(map, vertex).belief[GridMap::index_of(vertex)]) / 255.0F;
}

bool edge_open(const WorldMap& map, CellIndex vertex, std::size_t k) {
  const GridTile* tile = map.grid().find(GridMap::tile_of(vertex));
  return tile != nullptr && ((tile->edges[GridMap::index_of(vertex)] >> k) & 1U) != 0;
}

Scene ramp(double degrees, double from_m, double to_m) {
  const double rise = std::tan(degrees * std::numbers::pi / 180);
  return [=](double x_m, double) {
    const bool on = x_m > from_m && x_m < to_m;
    return Ground{rise * (std::clamp(x_m, from_m, to_m) - from_m), on ? rise : 0.0};
  };
}

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
  EXPECT_EQ(count(map, {}), (Counts{.free = 79 * 40, .blocked = 40}));
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

struct Pitches {
  double pitch_m;
  double resolution_m;
};

class Resolutions : public testing::TestWithParam<Pitches> {
 protected:
  static MappingSettings settings() {
    MappingSettings settings;
    settings.resolution_m = GetParam().resolution_m;
    settings.terrain_resolution_m = 4 * GetParam().resolution_m;
    return settings;
  }
};

TEST_P(Resolutions, RampOfFiveDegreesIsFreeAndLeadsUp) {
  const Area area{0, 6, -1.2, 1.2};
  const Scene scene = ramp(5, 1.2, 4.8);
  const WorldMap map = mapped({see(scene, area, GetParam().pitch_m)}, settings());
  const Counts counts = count(map, area);
  EXPECT_EQ(counts.blocked, 0);
  EXPECT_EQ(counts.unknown, 0);
  EXPECT_NEAR(height_at(map, 5.5, 0), 3.6 * std::tan(5 * std::numbers::pi / 180), 2e-3);
  for (CellIndex vertex = at(map, 0.1, 0); vertex.ix < at(map, 5.9, 0).ix; ++vertex.ix)
    EXPECT_TRUE(edge_open(map, vertex, 0)) << vertex.ix;
}

TEST_P(Resolutions, BoxOnTheFloorIsBlocked) {
  const Area area{0, 3.6, -1.2, 1.2};
  const Area box{1.2, 2.4, -0.6, 0.6};
  const WorldMap map = mapped({see(with_block(flat(), box, 0.1), area, GetParam().pitch_m)}, settings());
  const Counts in_box = count(map, box);
  EXPECT_EQ(in_box.free + in_box.unknown, 0);
  const Counts all = count(map, area);
  EXPECT_EQ(all.blocked, in_box.blocked);
  EXPECT_EQ(all.unknown, 0);
}

TEST_P(Resolutions, LowStepIsFreeAndHighStepIsCutOff) {
  const Area area{0, 3.6, -1.2, 1.2};
  const Area upper{2.4, 3.6, -1.2, 1.2};
  const auto states = [&](double step_m) {
    return count(mapped({see(with_block(flat(), upper, step_m), area, GetParam().pitch_m)}, settings()),
                 upper);
  };
  EXPECT_EQ(states(0.019).blocked, 0);
  EXPECT_EQ(states(0.019).unknown, 0);
  EXPECT_EQ(states(0.025).free, 0);
  EXPECT_EQ(states(0.025).unknown, 0);
}

INSTANTIATE_TEST_SUITE_P(All, Resolutions,
                         testing::Values(Pitches{0.05, 0.05}, Pitches{0.025, 0.025}, Pitches{0.025, 0.05},
                                         Pitches{0.05, 0.1}, Pitches{0.1, 0.1}, Pitches{0.05, 0.2},
                                         Pitches{0.05, 0.3}),
                         [](const auto& info) {
                           return std::to_string(std::lround(1000 * info.param.pitch_m)) + "mm_in_" +
                                  std::to_string(std::lround(1000 * info.param.resolution_m)) + "mm";
                         });

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

TEST(WorldMap, TooSteepASlopeIsBlocked) {
  const WorldMap map = mapped({see(ramp(12, 1.5, 2.5))});
  EXPECT_EQ(count(map, {1.5, 2.5, -1, 1}), (Counts{.blocked = 20 * 40}));
}

TEST(WorldMap, TheRobotsChassisAndItsTippingLimitWhatItsWheelsCouldTake) {
  const Scene step = [](double x_m, double) { return Ground{x_m > 2 ? 0.03 : 0.0}; };
  const Scene ramp = [](double x_m, double) { return Ground{0.15 * x_m, 0.15, 0}; };
  RobotSettings sturdy;
  sturdy.max_step_m = 0.035;
  sturdy.max_slope_deg = 12;
  RobotSettings low = sturdy;
  low.ground_clearance_m = 0.025;
  RobotSettings top_heavy = sturdy;
  top_heavy.center_of_gravity_m = 1.0;
  const auto free_at = [](const Scene& scene, const RobotSettings& robot, double x_m) {
    const WorldMap map = mapped({see(scene), see(scene), see(scene)}, {}, robot);
    return map.grid().state(map.grid().lattice().cell_of(x_m, 0.025)) == VertexState::kFree;
  };
  EXPECT_TRUE(free_at(step, sturdy, 3));
  EXPECT_FALSE(free_at(step, low, 3));
  EXPECT_TRUE(free_at(ramp, sturdy, 0.5));
  EXPECT_FALSE(free_at(ramp, top_heavy, 0.5));
}

TEST(WorldMap, GroundBelowAnEdgeIsBlocked) {
  const Area below{2.0, 4.0, -1, 1};
  const WorldMap map = mapped({see(with_block(flat(), below, -0.17))});
  EXPECT_EQ(count(map, below), (Counts{.blocked = 40 * 40}));
  EXPECT_EQ(count(map, {0, 2, -1, 1}), (Counts{.free = 40 * 40}));
}

TEST(WorldMap, MissingFloorBesideTheFloorIsADrop) {
  FloorEvidence frame = see(flat(), {0, 2, -1, 1});
  for (std::int32_t ix = 40; ix < 60; ++ix) {
    for (std::int32_t iy = -20; iy < 20; ++iy) {
      CellEvidence nothing;
      nothing.cell = {ix, iy};
      nothing.no_return = true;
      frame.cells.push_back(nothing);
    }
  }
  EXPECT_EQ(count(mapped({frame, frame}), {2, 3, -1, 1}).blocked, 0);
  WorldMap map = mapped({frame, frame, frame});
  EXPECT_EQ(count(map, {2, 2.1, -1, 1}), (Counts{.blocked = 2 * 40}));
  EXPECT_EQ(count(map, {2.1, 3, -1, 1}), (Counts{.unknown = 18 * 40}));
  map.integrate(see(flat()));
  map.refresh();
  EXPECT_EQ(count(map, {}), (Counts{.free = 80 * 40}));
}

TEST(WorldMap, FarFloorBehindUnknownGroundIsFree) {
  const WorldMap map = mapped({see(with_hole(flat(), {1.5, 2.5, -2, 2}))});
  EXPECT_EQ(count(map, {2.5, 4, -1, 1}), (Counts{.free = 30 * 40}));
}

TEST(WorldMap, RampSeenBehindUnknownGroundIsFreeButABoxIsNot) {
  const Area hole{1.2, 1.4, -2, 2};
  EXPECT_EQ(count(mapped({see(with_hole(ramp(6, 1.0, 3.0), hole))}), {1.4, 4, -1, 1}).blocked, 0);
  const Area box{1.4, 2.0, -1, 1};
  EXPECT_EQ(count(mapped({see(with_hole(with_block(flat(), box, 0.1), hole))}), box).free, 0);
}

TEST(WorldMap, RoomBehindAWallOnTheSameLevelIsFree) {
  const WorldMap map = mapped({see(with_block(flat(), {2.0, 2.1, -2, 2}, 0.5))});
  EXPECT_EQ(count(map, {2.0, 2.1, -1, 1}), (Counts{.blocked = 2 * 40}));
  EXPECT_EQ(count(map, {2.1, 4, -1, 1}), (Counts{.free = 38 * 40}));
}

TEST(WorldMap, FloorIsWhatTheRobotStandsOnNotZero) {
  FloorEvidence frame = see(with_block(flat(5.0), kBox, 5.1));
  frame.T_world_body.translation().z() = 5.0;
  const WorldMap map = mapped({frame});
  EXPECT_EQ(count(map, {}), (Counts{.free = 80 * 40 - 100, .blocked = 100}));
  EXPECT_EQ(belief_at(map, 1, 0), 1.0F);
  EXPECT_NEAR(belief_at(map, 1.75, 0), 1 - 0.1 / 0.75, 0.003);
}

TEST(WorldMap, FloorAFewCentimetresOffTheBodyIsStillTheFloor) {
  const WorldMap map = mapped({see(with_block(flat(-0.05), kBox, 0.05))});
  EXPECT_EQ(count(map, kBox), (Counts{.blocked = 100}));
  EXPECT_EQ(count(map, {}).free, 80 * 40 - 100);
}

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

class RandomFields : public testing::TestWithParam<unsigned> {};

// Brute force over the whole map: which steps are open by eq. (2), which vertices the robot reaches, which
// edges follow.
TEST_P(RandomFields, EdgesAreThoseOfEquation2) {
  std::mt19937 random(GetParam());
  constexpr int kSide = 70;
  std::vector<double> heights(kSide * kSide);
  for (double& z_m : heights) z_m = 0.005 * static_cast<int>(random() % 10);
  const auto height = [&](int ix, int iy) { return heights[static_cast<std::size_t>(iy * kSide + ix)]; };
  const Scene scene = [&](double x_m, double y_m) {
    return Ground{height(static_cast<int>(x_m / 0.05), static_cast<int>(y_m / 0.05))};
  };
  RobotSettings robot;
  robot.max_step_m = 0.0225;  // between the heights that occur, so that rounding decides nothing
  const WorldMap map = mapped({see(scene, {0, kSide * 0.05, 0, kSide * 0.05})}, {}, robot);
  const auto free = [&](int ix, int iy) { return map.grid().state({ix, iy}) == VertexState::kFree; };
  const auto side_open = [&](int ix, int iy, int dx, int dy) {
    return free(ix, iy) && free(ix + dx, iy + dy) &&
           std::abs(height(ix, iy) - height(ix + dx, iy + dy)) <= robot.max_step_m;
  };
  int open = 0;
  for (int iy = 1; iy < kSide - 1; ++iy) {
    for (int ix = 1; ix < kSide - 1; ++ix) {
      for (std::size_t k = 0; k < 8; ++k) {
        const int dx = kNeighbourX[k];
        const int dy = kNeighbourY[k];
        bool expected = side_open(ix, iy, dx, dy);
        if (dx != 0 && dy != 0)
          expected = expected && side_open(ix, iy, dx, 0) && side_open(ix, iy, 0, dy) &&
                     side_open(ix + dx, iy, 0, dy) && side_open(ix, iy + dy, dx, 0);
        EXPECT_EQ(edge_open(map, {ix, iy}, k), expected) << ix << " " << iy << " " << k;
        EXPECT_EQ(edge_open(map, {ix, iy}, k), edge_open(map, {ix + dx, iy + dy}, (k + 4) % 8));
        open += expected;
      }
    }
  }
  EXPECT_GT(open, 1000);
}

TEST_P(RandomFields, ReachableVerticesAreFreeAndIslandsBesideThemAreNot) {
  std::mt19937 random(GetParam());
  constexpr int kSide = 60;
  std::vector<double> heights(kSide * kSide, 0.0);
  std::vector<int> blocks(kSide * kSide, 0);
  for (int block = 0; block < 25; ++block) {  // plateaus that stand apart, each of one height above T
    const int ix = 2 + static_cast<int>(random() % 50);
    const int iy = 2 + static_cast<int>(random() % 50);
    const double z_m = 0.03 + 0.05 * static_cast<int>(random() % 5);
    for (int y = iy; y < iy + 5; ++y)
      for (int x = ix; x < ix + 5; ++x) heights[static_cast<std::size_t>(y * kSide + x)] = z_m;
  }
  const Scene scene = [&](double x_m, double y_m) {
    return Ground{heights[static_cast<std::size_t>(static_cast<int>(y_m / 0.05) * kSide +
                                                   static_cast<int>(x_m / 0.05))]};
  };
  const WorldMap map = mapped({see(scene, {0, kSide * 0.05, 0, kSide * 0.05})});
  std::vector<char> reached(kSide * kSide, 0);
  std::vector<int> queue{0};
  reached[0] = 1;
  while (!queue.empty()) {
    const int from = queue.back();
    queue.pop_back();
    for (std::size_t k = 0; k < 8; k += 2) {
      const int x = from % kSide + kNeighbourX[k];
      const int y = from / kSide + kNeighbourY[k];
      if (x < 0 || y < 0 || x >= kSide || y >= kSide) continue;
      const int to = y * kSide + x;
      const auto z_m = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
      if (reached[static_cast<std::size_t>(to)] || std::abs(z_m(to) - z_m(from)) > 0.02) continue;
      reached[static_cast<std::size_t>(to)] = 1;
      queue.push_back(to);
    }
  }
  for (int i = 0; i < kSide * kSide; ++i) {
    const bool floor = reached[static_cast<std::size_t>(i)];
    if (!floor && heights[static_cast<std::size_t>(i)] == 0.0)
      continue;  // a pit between plateaus: level, not joined
    EXPECT_EQ(map.grid().state({i % kSide, i / kSide}), floor ? VertexState::kFree : VertexState::kBlocked)
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFields, testing::Range(1U, 9U));

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
  absurd.lattice.pitch_m = std::nan("");
  EXPECT_THROW(map.integrate(absurd), std::invalid_argument);
  map.integrate(see(flat(), {}, 0.05));
  EXPECT_THROW(map.integrate(see(flat(), {}, 0.025)), std::invalid_argument);
}

TEST(Terrain, ShowsAllHeightsAtItsOwnResolution) {
  WorldMap map = mapped({see(with_block(ramp(5, 2.4, 3.2), {0.8, 1.6, -0.4, 0.4}, 0.5))});
  map.refresh_terrain();
  const TerrainMap& terrain = map.terrain();
  const auto height = [&](double x_m, double y_m) {
    return terrain.height_m(terrain.lattice().cell_of(x_m, y_m));
  };
  EXPECT_NEAR(height(0.5, 0), 0, 1e-3);
  EXPECT_NEAR(height(1.3, 0.1), 0.5, 1e-3);
  EXPECT_NEAR(height(2.9, 0.5), 0.5 * std::tan(5 * std::numbers::pi / 180), 1e-3);
  EXPECT_TRUE(std::isnan(height(5, 0)));
  EXPECT_TRUE(std::isnan(height(-0.1, 0)));
}

TEST(Terrain, FollowsChangesOnly) {
  WorldMap map = mapped({see(flat(), {-4, 4, -4, 4})});
  const auto first = map.refresh_terrain();
  EXPECT_EQ(first, map.terrain().sorted_tiles());
  EXPECT_TRUE(map.refresh_terrain().empty());
  map.integrate(see(flat(0.4), {1.0, 1.2, 1.0, 1.2}));
  map.refresh();
  EXPECT_EQ(map.refresh_terrain(), (std::vector<CellIndex>{{0, 0}}));
  EXPECT_NEAR(map.terrain().height_m(map.terrain().lattice().cell_of(1.1, 1.1)), 0.4, 1e-3);
}

}  // namespace
}  // namespace floornav
