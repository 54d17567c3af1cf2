#include "mapping/view_coverage.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

/// A floor of which one cell shows only some of its 40 points.
FloorEvidence with_points(CellIndex cell, std::int32_t points, double z_m = 0) {
  FloorEvidence frame = see(flat());
  frame.T_body_sensor.translation().z() = 0.7;
  for (CellEvidence& evidence : frame.cells) {
    evidence.points = 40;
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

Coverage coverage_of(CellIndex cell, const FloorEvidence& frame) {
  std::vector<std::uint32_t> entries(frame.cells.size());
  std::iota(entries.begin(), entries.end(), 0U);
  ViewCoverage coverage(0.005F);
  coverage.take(frame, entries);
  const auto it = std::ranges::find(frame.cells, cell, &CellEvidence::cell);
  return coverage.of(frame, static_cast<std::uint32_t>(it - frame.cells.begin()));
}

constexpr CellIndex kCell{41, 0};

TEST(ViewCoverage, CellLikeThoseAroundItIsSeenWhole) {
  EXPECT_EQ(coverage_of(kCell, with_points(kCell, 40)), Coverage::kWhole);
  EXPECT_EQ(coverage_of(kCell, with_points(kCell, 16)), Coverage::kWhole);
}

TEST(ViewCoverage, CellWithFewerPointsIsSeenInPartOrHardly) {
  EXPECT_EQ(coverage_of(kCell, with_points(kCell, 10)), Coverage::kPart);
  EXPECT_EQ(coverage_of(kCell, with_points(kCell, 3)), Coverage::kGlimpse);
}

TEST(ViewCoverage, CellWithFewerPointsBesideOneWithoutIsHardlySeen) {
  FloorEvidence frame = with_points(kCell, 10);
  std::erase_if(frame.cells, [](const CellEvidence& cell) { return cell.cell == CellIndex{42, 1}; });
  EXPECT_EQ(coverage_of(kCell, frame), Coverage::kGlimpse);
  EXPECT_EQ(coverage_of({41, 1}, frame), Coverage::kWhole);
}

TEST(ViewCoverage, SmallThingThatStandsOutOfTheFloorIsSeenWhole) {
  EXPECT_EQ(coverage_of(kCell, with_points(kCell, 3, 0.008)), Coverage::kWhole);
  EXPECT_EQ(coverage_of(kCell, with_points(kCell, 3, -0.008)), Coverage::kWhole);
}

TEST(ViewCoverage, FloorRightBehindASideIsTheSidesFoot) {
  EXPECT_EQ(coverage_of(kCell, with_side(with_points(kCell, 40), 0.4F)), Coverage::kGlimpse);
  EXPECT_EQ(coverage_of({39, 0}, with_side(with_points(kCell, 40), 0.4F)), Coverage::kWhole);
  EXPECT_EQ(coverage_of({42, 1}, with_side(with_points(kCell, 40), 0.4F)), Coverage::kWhole);
}

TEST(ViewCoverage, TopRightBehindItsOwnSideIsSeenWhole) {
  EXPECT_EQ(coverage_of(kCell, with_side(with_points(kCell, 40, 0.4), 0.41F)), Coverage::kWhole);
}

TEST(ViewCoverage, GlimpsesOfFloorLeaveACellUnknown) {
  const std::vector<FloorEvidence> frames(20, with_points(kCell, 3));
  const WorldMap map = mapped(frames);
  EXPECT_EQ(map.grid().state(kCell), VertexState::kUnknown);
  EXPECT_EQ(count(map, {}), (Counts{.unknown = 1, .free = 80 * 40 - 1}));
}

}  // namespace
}  // namespace floornav
