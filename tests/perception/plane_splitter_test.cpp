#include "perception/plane_splitter.hpp"

#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr float kThreshold = 2.5F;
constexpr float kCertainty_m = 600.0F;
constexpr float kPixel = 1.0F / 550.0F;  // a ray's width

/// A small thing 4.5 m off: its side, upright, up to ray_y = 0.1, and its top, of which a ray comes 2.5 times
/// as far as the side in the same angle. Along each ray the farther plane counts.
constexpr InverseDepthPlane kSide{0.05F, 0.0F, 0.22F};
constexpr InverseDepthPlane kTop{0.05F, 1.6F, 0.06F};

/// Points of a patch of `columns` x `rows` rays around the edge, with the sensor's noise.
PlanePool patch(int columns, int rows, bool with_top, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0F, 1.0F / kCertainty_m);
  PlanePool pool;
  pool.resize(static_cast<std::size_t>(columns * rows));
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const int n = static_cast<int>(i);
    const float x = kPixel * static_cast<float>(n % columns);
    const float y = 0.1F + kPixel * static_cast<float>(n / columns - rows / 2);
    const float side = kSide.inverse_depth(x, y);
    pool.ray_x[i] = x;
    pool.ray_y[i] = y;
    pool.inverse_depth[i] = (with_top ? std::min(side, kTop.inverse_depth(x, y)) : side) + noise(random);
    pool.certainty[i] = kCertainty_m;
  }
  return pool;
}

/// Splits the one plane that fits all points best.
std::optional<PlanePair> split_whole(const PlanePool& pool) {
  PlaneFit fit;
  for (std::size_t i = 0; i < pool.size(); ++i)
    fit.add(pool.ray_x[i], pool.ray_y[i], pool.inverse_depth[i], kCertainty_m * kCertainty_m);
  const InverseDepthPlane whole = *fit.solve();
  std::vector<Claim> claims(pool.size());
  std::vector<float> distance(pool.size());
  for (std::size_t i = 0; i < pool.size(); ++i) {
    distance[i] = std::abs(pool.residual(i, whole));
    claims[i] = distance[i] <= kThreshold ? Claim::kPoint : Claim::kNone;
  }
  PlaneSplitter splitter;
  return splitter.split(pool, claims, distance, kThreshold);
}

class Splitter : public testing::TestWithParam<unsigned> {};

TEST_P(Splitter, FindsTheSideAndTheTopOfAThingWhosePointsOnePlaneTook) {
  const PlanePool pool = patch(40, 12, true, GetParam());
  const auto pair = split_whole(pool);
  ASSERT_TRUE(pair);
  const std::size_t top = pair->planes[0].b > pair->planes[1].b ? 0 : 1;
  for (const float x : {0.0F, 39 * kPixel}) {
    EXPECT_NEAR(pair->planes[top].inverse_depth(x, 0.09F), kTop.inverse_depth(x, 0.09F), 1.2F / kCertainty_m);
    EXPECT_NEAR(pair->planes[1 - top].inverse_depth(x, 0.11F), kSide.inverse_depth(x, 0.11F),
                1.2F / kCertainty_m);
  }
}

TEST_P(Splitter, GivesEachRayThePlaneThatItMeets) {
  const PlanePool pool = patch(40, 12, true, GetParam());
  const auto pair = split_whole(pool);
  ASSERT_TRUE(pair);
  const bool top_is_first = pair->planes[0].b > pair->planes[1].b;
  EXPECT_EQ(pair->meets_first(0.03F, 0.09F), top_is_first);
  EXPECT_EQ(pair->meets_first(0.03F, 0.11F), !top_is_first);
}

TEST_P(Splitter, LeavesOnePlaneWhole) {
  EXPECT_FALSE(split_whole(patch(40, 12, false, GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Splitter, testing::Range(1U, 21U));

TEST(PlaneSplitter, TellsWhereOneOfThePlanesOwnsHardlyAPoint) {
  const PlanePool pool = patch(40, 12, true, 1);
  const std::vector<Claim> claims(pool.size(), Claim::kPoint);
  EXPECT_TRUE(PlaneSplitter::both_own_points(pool, claims, {{kSide, kTop}, {}}));
  InverseDepthPlane behind = kTop;
  behind.c += 0.05F;
  EXPECT_FALSE(PlaneSplitter::both_own_points(pool, claims, {{kSide, behind}, {}}));
}

TEST(PlaneSplitter, LeavesWholeWhatHasTooFewPointsForTwo) {
  EXPECT_FALSE(split_whole(patch(9, 6, true, 1)));
}

}  // namespace
}  // namespace floornav
