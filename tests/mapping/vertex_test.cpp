#include "mapping/vertex.hpp"

#include <array>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr float kPitch_m = 0.05F;
constexpr float kStep_m = 0.02F;

/// A cell that remembers one plane that rises along x, seen as far up as `reach` says.
CellMemory cell(float z_m, float rise_per_m, std::int8_t reach = 0) {
  Level level;
  level.z_m = z_m;
  level.var_m2 = 1e-6F;
  level.gradient_x = rise_per_m;
  level.support = Level::kTrusted;
  level.reach = reach;
  return {level, Level{}, std::numeric_limits<float>::quiet_NaN(), 0};
}

/// Of 2 x 2 cells: two at the left, two at the right.
SquareSummary square(const CellMemory& left, const CellMemory& right) {
  const std::array<CellMemory, 4> cells{left, right, left, right};
  return summarise(cells, 2, kPitch_m, kStep_m);
}

TEST(SquareOfCells, OnOnePlaneHasItsHeightInTheMiddle) {
  const SquareSummary summary = square(cell(0.0F, 0.2F), cell(0.01F, 0.2F));
  EXPECT_FALSE(summary.stepped);
  EXPECT_NEAR(summary.surface.z_m, 0.005F, 1e-6F);
}

/// A slope says nothing beyond the edge where it ends, so its height is not carried on to the middle.
TEST(SquareOfCells, AcrossAnEdgeIsAsHighAsTheHighestCellInItsPlace) {
  const SquareSummary summary = square(cell(0.0F, 0.0F), cell(0.3F, -0.8F));
  EXPECT_TRUE(summary.stepped);
  EXPECT_FLOAT_EQ(summary.surface.z_m, 0.3F);
}

/// Cells that are alike within their noise share their height: the highest of many alone is too high.
TEST(SquareOfCells, AcrossAnEdgeCellsAsHighAsTheHighestTellItsHeightTogether) {
  const std::array<CellMemory, 4> cells{cell(0.0F, 0.0F), cell(0.298F, 0.0F), cell(0.29F, 0.0F),
                                        cell(0.3F, 0.0F)};
  const SquareSummary summary = summarise(cells, 2, kPitch_m, kStep_m);
  EXPECT_TRUE(summary.stepped);
  EXPECT_NEAR(summary.surface.z_m, 0.299F, 1e-6F);
}

/// The upper end of a sloped top: its cell rises by 1 cm from its centre to its corner.
TEST(SquareOfCells, AcrossAnEdgeASlopeIsAsHighAsItsHighestPlaceThatWasSeen) {
  const CellMemory floor = cell(0.0F, 0.0F);
  EXPECT_NEAR(square(floor, cell(0.3F, 0.4F, Surface::kCorner)).surface.z_m, 0.31F, 1e-6F);
  EXPECT_NEAR(square(floor, cell(0.3F, -0.4F, 1)).surface.z_m, 0.3F + 0.01F / Surface::kCorner, 1e-6F);
  EXPECT_NEAR(square(floor, cell(0.3F, 0.4F, -Surface::kCorner)).surface.z_m, 0.29F, 1e-6F);
}

TEST(SquareOfCells, SeenInPartIsCarriedOnAlongFloorButNotAlongWhatIsSteeper) {
  EXPECT_NEAR(square(cell(0.0F, 0.2F, Surface::kCorner), CellMemory{}).surface.z_m, 0.005F, 1e-6F);
  EXPECT_NEAR(square(cell(0.0F, 0.5F, Surface::kCorner), CellMemory{}).surface.z_m, 0.0F, 1e-6F);
}

/// A sloped top that ends in the left cells: there is nothing of it in the square's middle.
TEST(SquareOfCells, SeenInPartIsNoHigherThanItsHighestPlaceThatWasSeen) {
  EXPECT_NEAR(square(cell(0.0F, 0.28F, 2), CellMemory{}).surface.z_m, 0.002F, 1e-6F);
  EXPECT_NEAR(square(cell(0.0F, 0.28F, -2), CellMemory{}).surface.z_m, -0.002F, 1e-6F);
}

TEST(SquareOfCells, NeverSeenHasNoSurface) {
  const std::array<CellMemory, 4> cells{};
  EXPECT_FALSE(summarise(cells, 2, kPitch_m, kStep_m).seen);
}

}  // namespace
}  // namespace floornav
