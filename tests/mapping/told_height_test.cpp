#include "mapping/told_height.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr float kResolution_m = 0.05F;
constexpr float kStep_m = 0.02F;

/// A tile of one cell a vertex.
class ToldHeight : public testing::Test {
 protected:
  ToldHeight() { tile.cells = CellStore(GridTile::kVertices, 0.0); }

  void remember(std::int32_t x, std::int32_t y, float z_m, float sigma_m, float rise = 0,
                std::int8_t reach = 0) {
    Level level;
    level.z_m = z_m;
    level.var_m2 = sigma_m * sigma_m;
    level.gradient_x = rise;
    level.reach = reach;
    level.support = Level::kMost;
    const VertexRef place{&tile, x, y};
    tile.cells.set(place.index(), {level, Level{}, std::numeric_limits<float>::quiet_NaN(), 0});
    place.vertex().set(Vertex::kSeen, true);
  }
  /// A cell of a side that faces x.
  void remember_side(std::int32_t x, std::int32_t y, float z_m, float sigma_m) {
    Level level;
    level.z_m = z_m;
    level.var_m2 = sigma_m * sigma_m;
    level.gradient_x = 30.0F;
    level.column = true;
    level.support = Level::kMost;
    const VertexRef place{&tile, x, y};
    tile.cells.set(place.index(), {level, Level{}, std::numeric_limits<float>::quiet_NaN(), 0});
    place.vertex().set(Vertex::kSeen, true);
  }
  [[nodiscard]] float told_m(std::int32_t x, std::int32_t y) {
    return highest_place({&tile, x, y}, kResolution_m, kStep_m).z_m;
  }

  MapTile tile;
};

TEST_F(ToldHeight, IsThatOfTheHighestPlaceThatWasSeen) {
  remember(5, 5, 0.3F, 0.001F, 0.2F, Surface::kCorner);
  EXPECT_NEAR(told_m(5, 5), 0.305F, 2e-5F);
  remember(5, 5, 0.3F, 0.001F, -0.2F, -Surface::kCorner);
  EXPECT_NEAR(told_m(5, 5), 0.295F, 2e-5F);
}

/// By the inverse of their variances: one part in eleven is its own.
TEST_F(ToldHeight, OfWhatIsHardlyKnownFollowsWhatIsKnownBesideIt) {
  const float sigma_m = std::sqrt(1e-5F);
  remember(5, 5, 0.308F, sigma_m);
  remember(4, 5, 0.3F, 0.001F);
  EXPECT_NEAR(told_m(5, 5), 0.3F + 0.008F / 11, 1e-4F);
  EXPECT_NEAR(told_m(4, 5), 0.3F, 2e-5F);
}

TEST_F(ToldHeight, IsItsOwnBesideWhatIsAsUncertainOrLiesElsewhere) {
  remember(5, 5, 0.308F, 0.0031F);
  remember(4, 5, 0.3F, 0.002F);
  remember(6, 5, 0.0F, 0.001F);
  EXPECT_NEAR(told_m(5, 5), 0.308F, 2e-5F);
}

/// Two on opposite sides tell as much as one that is twice as well known.
TEST_F(ToldHeight, OfWhatIsWellKnownIsTheMeanWithWhatLiesOnOppositeSides) {
  remember(5, 5, 0.303F, 0.001F);
  for (const std::int32_t x : {4, 6}) remember(x, 5, 0.3F, 0.001F);
  EXPECT_NEAR(told_m(5, 5), 0.301F, 2e-5F);
}

TEST_F(ToldHeight, OfASlopeIsItsOwn) {
  for (const std::int32_t x : {4, 5, 6}) remember(x, 5, 0.3F + 0.01F * static_cast<float>(x), 0.001F);
  EXPECT_NEAR(told_m(5, 5), 0.35F, 2e-5F);
}

TEST_F(ToldHeight, IsItsOwnWhereNoiseCouldHideAStepOrOneSideIsUnseen) {
  remember(5, 5, 0.303F, 0.002F);
  for (const std::int32_t x : {4, 6}) remember(x, 5, 0.3F, 0.002F);
  EXPECT_NEAR(told_m(5, 5), 0.303F, 2e-5F);
  remember(8, 5, 0.303F, 0.001F);
  remember(9, 5, 0.3F, 0.001F);
  EXPECT_NEAR(told_m(8, 5), 0.303F, 2e-5F);
}

/// The highest of four cells, each 1 cm higher than the one before: what was seen of it reaches a fifth of
/// a cell farther up.
TEST_F(ToldHeight, OfASideWhoseEdgeRisesIsItsUpperEnd) {
  for (const std::int32_t y : {2, 3, 4, 5})
    remember_side(5, y, 0.3F + 0.01F * static_cast<float>(y), 0.0005F);
  EXPECT_NEAR(told_m(5, 5), 0.352F, 2e-4F);
}

TEST_F(ToldHeight, OfASideIsItsOwnWhereItsEdgeIsLevelOrEndsInAStep) {
  for (const std::int32_t y : {3, 4, 5}) remember_side(5, y, 0.3F, 0.0005F);
  EXPECT_NEAR(told_m(5, 5), 0.3F, 2e-5F);
  remember_side(5, 2, 0.28F, 0.0005F);
  EXPECT_NEAR(told_m(5, 3), 0.3F, 2e-5F);
}

}  // namespace
}  // namespace floornav
