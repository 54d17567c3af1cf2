#include "mapping/frame_alignment.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "mapping/world_map.hpp"
#include "tests/mapping/made_evidence.hpp"

namespace floornav {
namespace {

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

/// `scene` as a frame shows it whose pose is off by a lift (m) and a tilt (m/m).
Scene tilted(const Scene& scene, double lift_m, double rise_x, double rise_y) {
  return [=](double x_m, double y_m) {
    std::optional<Ground> ground = scene(x_m, y_m);
    if (ground)
      ground = Ground{ground->z_m + lift_m + rise_x * x_m + rise_y * y_m, ground->rise_x + rise_x,
                      ground->rise_y + rise_y};
    return ground;
  };
}

struct Jump {
  double lift_m;
  double rise_x;
  double rise_y;
};

std::vector<Jump> jitter(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> lift_m(0, 0.01);
  std::normal_distribution<double> rise(0, 0.3 * 3.14159 / 180);
  std::vector<Jump> jumps;
  for (int i = 0; i < 20; ++i) {
    const double lift = lift_m(random);
    const double rise_x = rise(random);
    jumps.push_back({lift, rise_x, rise(random)});
  }
  return jumps;
}

std::vector<FloorEvidence> jittering_frames(unsigned seed) {
  std::vector<FloorEvidence> frames;
  for (const Jump& jump : jitter(seed))
    frames.push_back(see(tilted(with_block(flat(), kBox, 0.1), jump.lift_m, jump.rise_x, jump.rise_y)));
  return frames;
}

/// Of the floor at vertex (5, 5).
double mean_lift_m(unsigned seed) {
  constexpr double kPlace_m = 5.5 * 0.05;
  double sum_m = 0;
  for (const Jump& jump : jitter(seed)) sum_m += jump.lift_m + kPlace_m * (jump.rise_x + jump.rise_y);
  return sum_m / 20;
}

int count_free(const WorldMap& map, bool in_box) {
  int free = 0;
  for (std::int32_t iy = -20; iy < 20; ++iy)
    for (std::int32_t ix = 0; ix < 80; ++ix)
      if (inside((ix + 0.5) * 0.05, (iy + 0.5) * 0.05, kBox) == in_box &&
          map.grid().state({ix, iy}) == VertexState::kFree)
        ++free;
  return free;
}

class Jitter : public testing::TestWithParam<unsigned> {};

TEST_P(Jitter, OfACentimetreAndAThirdOfADegreeMakesNoFalseEdges) {
  WorldMap map(MappingSettings{}, RobotSettings{});
  for (const FloorEvidence& frame : jittering_frames(GetParam())) {
    map.integrate(frame);
    map.refresh();
    EXPECT_EQ(count_free(map, false), 80 * 40 - 100);
    EXPECT_EQ(count_free(map, true), 0);
  }
  const GridTile& tile = *map.grid().find({0, 0});
  for (std::int32_t i = 1; i + 1 < 31; ++i)
    EXPECT_EQ(tile.edges[static_cast<std::size_t>(10 * 32 + i)], 0xFF);
}

TEST_P(Jitter, LeavesALevelFloorNearTheMeanOfThePoses) {
  WorldMap map(MappingSettings{}, RobotSettings{});
  const auto frames = jittering_frames(GetParam());
  for (const FloorEvidence& frame : frames) map.integrate(frame);
  map.refresh();
  const auto height = [&](std::int32_t ix, std::int32_t iy) {
    return map.grid().find(GridMap::tile_of({ix, iy}))->height_m(GridTile::index_of({ix, iy}));
  };
  EXPECT_NEAR(height(5, 5), mean_lift_m(GetParam()), 0.003);
  for (std::int32_t ix = 1; ix < 79; ++ix) EXPECT_NEAR(height(ix, 10), height(ix - 1, 10), 0.0016) << ix;
}

INSTANTIATE_TEST_SUITE_P(Seeds, Jitter, testing::Range(1U, 9U));

class KnownError : public testing::TestWithParam<unsigned> {};

TEST_P(KnownError, IsFoundAlthoughThingsHaveChanged) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> unit(-1, 1);
  WorldMap map(MappingSettings{}, RobotSettings{});
  map.integrate(see(flat()));
  const double lift = 0.03 * unit(random);
  const double rise_x = 0.02 * unit(random);
  const double rise_y = 0.02 * unit(random);
  MapTiles tiles;
  tiles.set_cells_per_vertex(1);
  WorldMemory memory(MappingSettings{}, RobotSettings{});
  memory.take(see(flat()), FloorHeight(0.05), tiles);
  const Scene changed = with_block(flat(), {1.0, 2.0, -1, 0}, 0.08);
  const HeightError error =
      find_height_error(see(tilted(changed, lift, rise_x, rise_y)), tiles, AlignmentSettings{});
  EXPECT_NEAR(error.lift_m, lift, 0.002);
  EXPECT_NEAR(error.rise.x(), rise_x, 0.002);
  EXPECT_NEAR(error.rise.y(), rise_y, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Seeds, KnownError, testing::Range(1U, 9U));

FloorEvidence on_dominant_floor(FloorEvidence frame) {
  for (Surfel& surfel : frame.surfels) surfel.dominant = true;
  return frame;
}

/// By how much the map of a floor is too high where the robot began, and 2 m before it.
Eigen::Vector2d level_start_error_m(double level_start_frames, double lift_m, double rise, int frames) {
  MappingSettings settings;
  settings.alignment.level_start_frames = level_start_frames;
  WorldMap map(settings, RobotSettings{});
  for (int i = 0; i < frames; ++i) map.integrate(on_dominant_floor(see(tilted(flat(), lift_m, rise, 0))));
  map.refresh();
  const auto height = [&](std::int32_t ix) {
    return static_cast<double>(
        map.grid().find(GridMap::tile_of({ix, 0}))->height_m(GridTile::index_of({ix, 0})));
  };
  return {height(0), height(40)};
}

/// Poses that err by 1 cm and 0.3 degrees in one direction, weighed against the level floor as that many
/// frames.
TEST(FrameAlignment, AFloorThatBeginsNearZeroIsTakenToLieThere) {
  constexpr double kLift_m = 0.01, kRise = 0.0052;
  for (const int frames : {1, 10}) {
    const double share = frames / (10.0 + frames);
    const Eigen::Vector2d error_m = level_start_error_m(10, kLift_m, kRise, frames);
    EXPECT_NEAR(error_m[0], share * kLift_m, 0.0015) << frames;
    EXPECT_NEAR(error_m[1], share * (kLift_m + 2.025 * kRise), 0.0015) << frames;
  }
  EXPECT_NEAR(level_start_error_m(0, kLift_m, kRise, 10)[0], kLift_m, 0.001);
}

TEST(FrameAlignment, AFloorThatBeginsElsewhereIsLeftThere) {
  EXPECT_NEAR(level_start_error_m(10, 0.5, 0, 3)[0], 0.5, 0.001);
  EXPECT_NEAR(level_start_error_m(10, 0, 0.05, 3)[1], 0.05 * 2.025, 0.001);
}

TEST(FrameAlignment, TakesOutExactlyTheErrorThatItIsGiven) {
  HeightError error;
  error.center_m = Eigen::Vector2d(1, -1);
  error.lift_m = 0.02;
  error.rise = Eigen::Vector2d(0.03, -0.01);
  const Scene wrong = tilted(flat(), 0.02 - 0.03 * 1 - 0.01 * 1, 0.03, -0.01);
  FloorEvidence frame = see(wrong);
  for (CellEvidence& cell : frame.cells) cell.ray_z_m = cell.mean_z_m + 0.5F;
  const FloorEvidence right = corrected(frame, error);
  for (std::size_t i = 0; i < right.cells.size(); ++i) {
    EXPECT_NEAR(right.cells[i].mean_z_m, 0, 1e-6);
    EXPECT_NEAR(right.cells[i].ray_z_m, 0.5, 1e-6);
    EXPECT_NEAR(right.surfels[i].normal.z(), 1, 1e-6);
    EXPECT_NEAR(right.surfels[i].centroid_m.z(), 0, 1e-6);
  }
}

TEST(FrameAlignment, IsClampedAndCanBeSwitchedOff) {
  MapTiles tiles;
  tiles.set_cells_per_vertex(1);
  WorldMemory memory(MappingSettings{}, RobotSettings{});
  memory.take(see(flat()), FloorHeight(0.05), tiles);
  AlignmentSettings settings;
  settings.max_lift_m = 0.01;
  EXPECT_DOUBLE_EQ(find_height_error(see(flat(0.04)), tiles, settings).lift_m, 0.01);
  settings.enabled = false;
  EXPECT_EQ(find_height_error(see(flat(0.04)), tiles, settings).lift_m, 0);
}

TEST(FrameAlignment, TooLittleInCommonIsNotCorrected) {
  MapTiles tiles;
  tiles.set_cells_per_vertex(1);
  WorldMemory memory(MappingSettings{}, RobotSettings{});
  memory.take(see(flat(), {0, 0.3, 0, 0.3}), FloorHeight(0.05), tiles);
  EXPECT_EQ(find_height_error(see(flat(0.02)), tiles, AlignmentSettings{}).lift_m, 0);
}

}  // namespace
}  // namespace floornav
