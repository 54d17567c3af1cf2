#include "mapping/view_coverage.hpp"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

/// A floor of which one cell shows only some of its 10 points.
FloorEvidence with_points(CellIndex cell, std::int32_t points, double z_m = 0) {
  FloorEvidence frame = see(flat());
  frame.T_body_sensor.translation().z() = 0.7;
  for (CellEvidence& evidence : frame.cells) {
    if (evidence.cell != cell) continue;
    evidence.points = points;
    evidence.mean_z_m = evidence.top_z_m = static_cast<float>(z_m);
  }
  return frame;
}

/// Turns cell (40, 0) into the foot of an upright side of some height.
FloorEvidence with_side(FloorEvidence frame, float top_m) {
  Surfel side;
  side.centroid_m = Eigen::Vector3d(2.02, 0.02, 0.2);
  side.normal = Eigen::Vector3f(-1, 0, 0);
  frame.surfels.push_back(side);
  for (CellEvidence& cell : frame.cells) {
    if (cell.cell != CellIndex{40, 0}) continue;
    cell.surfel = static_cast<std::int16_t>(frame.surfels.size() - 1);
    cell.top_z_m = top_m;
  }
  return frame;
}

std::int32_t points_that_count(const FloorEvidence& frame, CellIndex cell) {
  std::vector<std::uint32_t> entries(frame.cells.size());
  std::iota(entries.begin(), entries.end(), 0U);
  ViewCoverage coverage(0.005F);
  coverage.take(frame, entries);
  for (const std::uint32_t entry : entries)
    if (frame.cells[entry].cell == cell) return coverage.points_that_count(frame, entry);
  return -1;
}

constexpr CellIndex kCell{41, 0};

TEST(ViewCoverage, CellLikeThoseAroundItCountsWhole) {
  EXPECT_EQ(points_that_count(with_points(kCell, 10), kCell), 10);
  EXPECT_EQ(points_that_count(with_points(kCell, 5), kCell), 5);
}

TEST(ViewCoverage, CellSeenInPartCountsOnceAndAGlimpseNotAtAll) {
  EXPECT_EQ(points_that_count(with_points(kCell, 3), kCell), 1);
  EXPECT_EQ(points_that_count(with_points(kCell, 2), kCell), 0);
}

TEST(ViewCoverage, SmallThingThatStandsOutOfTheFloorCountsWhole) {
  EXPECT_EQ(points_that_count(with_points(kCell, 2, 0.008), kCell), 2);
  EXPECT_EQ(points_that_count(with_points(kCell, 2, -0.008), kCell), 2);
}

TEST(ViewCoverage, FloorRightBehindASideIsTheSidesFoot) {
  EXPECT_EQ(points_that_count(with_side(with_points(kCell, 10), 0.4F), kCell), 0);
  EXPECT_EQ(points_that_count(with_side(with_points(kCell, 10), 0.4F), {39, 0}), 10);
  EXPECT_EQ(points_that_count(with_side(with_points({42, 1}, 10), 0.4F), {42, 1}), 10);
}

TEST(ViewCoverage, TopRightBehindItsOwnSideCountsWhole) {
  EXPECT_EQ(points_that_count(with_side(with_points(kCell, 10, 0.4), 0.41F), kCell), 10);
}

TEST(ViewCoverage, GlimpsesOfFloorLeaveACellUnknown) {
  const std::vector<FloorEvidence> frames(20, with_points(kCell, 2));
  const WorldMap map = mapped(frames);
  EXPECT_EQ(map.grid().state(kCell), VertexState::kUnknown);
  EXPECT_EQ(count(map, {}), (Counts{.unknown = 1, .free = 80 * 40 - 1}));
}

TEST(ViewCoverage, PartOfACellIsFloorWithTheThirdFrame) {
  const FloorEvidence part = with_points(kCell, 3);
  EXPECT_EQ(mapped({part, part}).grid().state(kCell), VertexState::kUnknown);
  EXPECT_EQ(mapped({part, part, part}).grid().state(kCell), VertexState::kFree);
}

}  // namespace
}  // namespace floornav
