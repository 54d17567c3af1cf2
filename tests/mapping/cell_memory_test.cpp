#include "mapping/cell_memory.hpp"

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr FusionLimits kLimits{.gate_m = 0.01F, .ray_margin_m = 0.02F, .memory_var_m2 = 1e-8F};

Sighting plane(float z_m, float sigma_m = 0.002F, std::int32_t points = 10) {
  Sighting sighting;
  sighting.z_m = z_m;
  sighting.var_m2 = sigma_m * sigma_m;
  sighting.points = points;
  sighting.lowest_z_m = z_m;
  return sighting;
}

Sighting column(float top_m, std::int32_t points = 10) {
  Sighting sighting = plane(top_m, 0.01F, points);
  sighting.column = true;
  return sighting;
}

void fuse(CellMemory& memory, const std::vector<Sighting>& sightings,
          float ray_z_m = std::numeric_limits<float>::infinity()) {
  memory.fuse({.sightings = sightings, .ray_z_m = ray_z_m}, kLimits);
}

class Fusion : public testing::TestWithParam<unsigned> {};

TEST_P(Fusion, IsTheMeanWeightedByVariance) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<float> sigma_m(0.002F, 0.02F);
  CellMemory memory;
  double weights = 0;
  double weighted_z = 0;
  double weighted_rise = 0;
  for (int view = 0; view < 20; ++view) {
    const float sigma = sigma_m(random);
    Sighting sighting = plane(std::uniform_real_distribution<float>(-0.004F, 0.004F)(random), sigma);
    sighting.gradient_x = std::uniform_real_distribution<float>(-0.1F, 0.1F)(random);
    fuse(memory, {sighting});
    const double weight = 1.0 / (static_cast<double>(sigma) * static_cast<double>(sigma));
    weights += weight;
    weighted_z += weight * static_cast<double>(sighting.z_m);
    weighted_rise += weight * static_cast<double>(sighting.gradient_x);
  }
  ASSERT_NE(memory.decider(), nullptr);
  EXPECT_NEAR(memory.decider()->z_m, weighted_z / weights, 1e-6);
  EXPECT_NEAR(memory.decider()->var_m2, 1 / weights, 1e-4 / weights);
  EXPECT_NEAR(memory.decider()->gradient_x, weighted_rise / weights, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Fusion, testing::Range(1U, 11U));

/// Views of a top, each seen as far up as it was: what they saw of it is averaged like its height.
TEST(CellMemory, HighestPlaceOfASlopeIsTheMeanOfThoseThatWereSeen) {
  CellMemory memory;
  for (const int reach : {3, 1, 2}) {
    Sighting sighting = plane(0.3F);
    sighting.gradient_x = 0.2F;
    sighting.reach = static_cast<std::int8_t>(reach);
    fuse(memory, {sighting});
  }
  ASSERT_NE(memory.decider(), nullptr);
  EXPECT_NEAR(memory.decider()->reach_m(0.05F), 0.005F * 2 / Surface::kCorner, 1e-6F);
}

/// Noise in the slope of what is level does not make it higher.
TEST(CellMemory, HighestPlaceOfWhatIsLevelIsItsHeight) {
  CellMemory memory;
  for (const float rise : {0.2F, -0.2F}) {
    Sighting sighting = plane(0.3F);
    sighting.gradient_x = rise;
    sighting.reach = Surface::kCorner;
    fuse(memory, {sighting});
  }
  EXPECT_NEAR(memory.decider()->reach_m(0.05F), 0.0F, 1e-5F);
}

TEST(CellMemory, VarianceHasAFloorSoThatTheHeightStillFollows) {
  CellMemory memory;
  FusionLimits limits = kLimits;
  limits.memory_var_m2 = 1e-6F;
  const std::vector<Sighting> before{plane(0.0F)};
  for (int view = 0; view < 1000; ++view) memory.fuse({.sightings = before}, limits);
  EXPECT_FLOAT_EQ(memory.decider()->var_m2, 1e-6F);
  const std::vector<Sighting> after{plane(0.005F)};
  for (int view = 0; view < 30; ++view) memory.fuse({.sightings = after}, limits);
  EXPECT_NEAR(memory.decider()->z_m, 0.005F, 1e-4F);
}

TEST(CellMemory, NearerViewWinsOverAFarWrongOne) {
  CellMemory memory;
  for (int view = 0; view < 5; ++view) fuse(memory, {plane(0.06F, 0.015F)});
  EXPECT_NEAR(memory.decider()->z_m, 0.06F, 1e-4F);
  for (int view = 0; view < 3; ++view) fuse(memory, {plane(0.0F, 0.002F)});
  EXPECT_NEAR(memory.decider()->z_m, 0.0F, 0.002F);
}

TEST(CellMemory, NothingSeenDecidesNothing) {
  CellMemory memory;
  fuse(memory, {}, 0.1F);
  EXPECT_EQ(memory.decider(), nullptr);
}

TEST(CellMemory, TwoPointsAreNotTrustedAtOnce) {
  CellMemory memory;
  fuse(memory, {plane(0, 0.002F, 2)});
  EXPECT_EQ(memory.decider(), nullptr);
  fuse(memory, {plane(0, 0.002F, 2)});
  EXPECT_NE(memory.decider(), nullptr);
}

TEST(CellMemory, HighestSurfaceDecides) {
  CellMemory memory;
  fuse(memory, {plane(0), plane(0.4F)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.4F);
  EXPECT_FLOAT_EQ(memory.lower().z_m, 0);
}

TEST(CellMemory, NewObstacleDecidesInItsFirstFrame) {
  CellMemory memory;
  for (int view = 0; view < 50; ++view) fuse(memory, {plane(0)});
  fuse(memory, {column(0.3F)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.3F);
}

TEST(CellMemory, AFewPointsAboveKnownFloorNeedAThirdFrame) {
  CellMemory memory;
  for (int view = 0; view < 5; ++view) fuse(memory, {plane(0)});
  fuse(memory, {plane(0), column(0.3F, 4)});
  fuse(memory, {plane(0), column(0.3F, 4)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0);
  fuse(memory, {plane(0), column(0.3F, 4)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.3F);
}

TEST(CellMemory, AFewPointsSeenOnceAboveKnownFloorAreForgotten) {
  CellMemory memory;
  for (int view = 0; view < 5; ++view) fuse(memory, {plane(0)});
  fuse(memory, {plane(0), column(0.3F, 4)});
  fuse(memory, {plane(0)});
  fuse(memory, {plane(0)});
  EXPECT_FALSE(memory.upper().exists());
}

TEST(CellMemory, AFewPointsDecideWhereNoFloorWasKnown) {
  CellMemory memory;
  fuse(memory, {plane(0), column(0.3F, 4)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.3F);
}

TEST(CellMemory, FloorSeenBelowClearsAnObstacleThatLeft) {
  CellMemory memory;
  for (int view = 0; view < 100; ++view) fuse(memory, {plane(0), column(1.0F)});
  for (int view = 0; view < 10; ++view) fuse(memory, {plane(0)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0);
}

TEST(CellMemory, SightLineBelowItsTopClearsAnObstacle) {
  CellMemory memory;
  for (int view = 0; view < 100; ++view) fuse(memory, {column(0.5F)});
  for (int view = 0; view < 9; ++view) fuse(memory, {}, 0.2F);
  ASSERT_NE(memory.decider(), nullptr);
  for (int view = 0; view < 3; ++view) fuse(memory, {}, 0.2F);
  EXPECT_EQ(memory.decider(), nullptr);
}

TEST(CellMemory, SightLineAboveItsTopClearsNothing) {
  CellMemory memory;
  fuse(memory, {column(0.5F)});
  for (int view = 0; view < 1000; ++view) fuse(memory, {}, 0.5F);
  EXPECT_NE(memory.decider(), nullptr);
}

TEST(CellMemory, SightLineThroughACellWhereTheObstacleIsSeenClearsNothing) {
  CellMemory memory;
  for (int view = 0; view < 1000; ++view) fuse(memory, {plane(0), column(0.5F)}, 0.05F);
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.5F);
}

TEST(CellMemory, ColumnIsAsHighAsTheHighestThatTwoViewsSaw) {
  CellMemory memory;
  fuse(memory, {column(0.5F)});
  fuse(memory, {column(0.2F)});
  fuse(memory, {column(0.6F)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.5F);
  fuse(memory, {column(0.6F)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.6F);
}

/// As poses that drift show it: what stands above a floor is not forgotten for that.
TEST(CellMemory, TopAboveAFloorStaysWhileEachViewShowsItHigher) {
  CellMemory memory;
  for (int view = 0; view < 5; ++view) fuse(memory, {plane(0)});
  for (int view = 0; view < 15; ++view) {
    fuse(memory, {plane(0), plane(0.3F + 0.02F * static_cast<float>(view))});
    EXPECT_GT(memory.decider()->z_m, 0.29F) << view;
  }
}

/// What lower views show of a column is part of it, but says nothing for a height that one view threw up.
TEST(CellMemory, ColumnThrownUpOnceIsNotBelievedForWhatIsSeenBelow) {
  CellMemory memory;
  for (int view = 0; view < 5; ++view) fuse(memory, {column(0.5F)});
  fuse(memory, {column(0.6F)});
  for (int view = 0; view < 5; ++view) fuse(memory, {column(0.4F)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.5F);
}

TEST(CellMemory, ColumnThrownUpByOnePointIsAsHighAsThoseThatMorePointsShow) {
  CellMemory memory;
  fuse(memory, {column(0.3F, 1)});
  fuse(memory, {column(0.2F, 4)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.2F);
  fuse(memory, {column(0.1F, 10)});
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.2F);
}

TEST(CellMemory, OfTheSameSurfaceAColumnKnowsTheHeightAndAPlaneTheSlope) {
  Sighting slanted = plane(0.21F, 0.02F);
  slanted.gradient_x = 0.3F;
  for (const bool plane_first : {true, false}) {
    CellMemory memory;
    fuse(memory, {plane_first ? slanted : column(0.2F)});
    fuse(memory, {plane_first ? column(0.2F) : slanted});
    EXPECT_FALSE(memory.decider()->column);
    EXPECT_FLOAT_EQ(memory.decider()->gradient_x, 0.3F);
    EXPECT_NEAR(memory.decider()->z_m, 0.202F, 1e-6F);  // 1 and 2 cm of uncertainty: weights 4 and 1
  }
}

TEST(CellMemory, TableTopFirstFloorBelowLater) {
  CellMemory memory;
  fuse(memory, {plane(0.7F)});
  fuse(memory, {plane(0), plane(0.7F)});
  EXPECT_FLOAT_EQ(memory.lower().z_m, 0);
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.7F);
}

TEST(CellMemory, NoReturnCountsUntilSomethingIsSeen) {
  CellMemory memory;
  for (int view = 0; view < 300; ++view) memory.fuse({.sightings = {}, .no_return = true}, kLimits);
  EXPECT_EQ(memory.floor_doubt(), CellMemory::kMostFloorDoubt);
  fuse(memory, {plane(0)});
  EXPECT_EQ(memory.floor_doubt(), 0);
}

/// Frames of a floor, in which an edge was seen through the cell or not.
void fuse_edges(CellMemory& memory, std::initializer_list<bool> on_edge) {
  const std::array<Sighting, 1> floor{plane(0)};
  for (const bool is_on_edge : on_edge) memory.fuse({.sightings = floor, .on_edge = is_on_edge}, kLimits);
}

TEST(CellMemory, AnEdgeThatOneFrameInFourShowsStays) {
  CellMemory memory;
  fuse_edges(memory, {true, true});
  for (int turn = 0; turn < 20; ++turn) {
    EXPECT_GE(memory.floor_doubt(), CellMemory::kOnEdge);
    fuse_edges(memory, {false, false, false, true});
  }
}

TEST(CellMemory, AnEdgeThatIsGoneIsForgottenAfterFourFrames) {
  CellMemory memory;
  for (int frame = 0; frame < 50; ++frame) fuse_edges(memory, {true});
  fuse_edges(memory, {false, false, false});
  EXPECT_GE(memory.floor_doubt(), CellMemory::kOnEdge);
  fuse_edges(memory, {false});
  EXPECT_LT(memory.floor_doubt(), CellMemory::kOnEdge);
  EXPECT_NE(memory.decider(), nullptr);
}

TEST(CellMemory, TwoLevelsFartherApartThanAStepAndTheirNoiseMakeAnEdge) {
  CellMemory memory;
  fuse(memory, {plane(0.0F), plane(0.1F)});
  EXPECT_TRUE(memory.is_stepped(0.02F));
  EXPECT_FALSE(memory.is_stepped(0.095F));
  CellMemory floor;
  fuse(floor, {plane(0.0F)});
  EXPECT_FALSE(floor.is_stepped(0.02F));
}

TEST(CellMemory, FloorSeenWholeNoMoreOftenThanInPartIsNotKnown) {
  CellMemory memory;
  for (int view = 0; view < 5; ++view) {
    fuse(memory, {plane(0)});
    EXPECT_NE(memory.decider(), nullptr);
    memory.fuse({.sightings = {}, .partly_hidden = true}, kLimits);
    EXPECT_EQ(memory.decider(), nullptr);
  }
}

TEST(CellMemory, FloorSeenWholeOftenStaysWhenSomethingComesBeforeIt) {
  CellMemory memory;
  for (int view = 0; view < 3; ++view) fuse(memory, {plane(0)});
  for (int view = 0; view < 50; ++view) memory.fuse({.sightings = {}, .partly_hidden = true}, kLimits);
  EXPECT_NE(memory.decider(), nullptr);
}

TEST(CellMemory, FloorInPartOfACellSpeaksLessAgainstWhatStandsInTheRest) {
  CellMemory whole;
  CellMemory part;
  fuse(whole, {column(0.4F)});
  fuse(part, {column(0.4F)});
  Sighting floor = plane(0.0F);
  fuse(whole, {floor});
  floor.in_part = true;
  fuse(part, {floor});
  EXPECT_EQ(whole.upper().support, 0);
  EXPECT_EQ(part.upper().support, Level::kPerFrame - 1);
}

}  // namespace
}  // namespace floornav
