#include "tools/simulator/random.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tools/simulator/noise_field.hpp"
#include "tools/simulator/portable_math.hpp"

namespace floornav {
namespace {

/// Largest distance between the numbers' distribution and the one of the standard normal distribution.
double kolmogorov_distance(std::vector<float> numbers) {
  std::ranges::sort(numbers);
  const auto n = static_cast<double>(numbers.size());
  double worst = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double expected = 0.5 * std::erfc(-static_cast<double>(numbers[i]) / std::sqrt(2.0));
    worst = std::max({worst, std::fabs(expected - static_cast<double>(i) / n),
                      std::fabs(expected - static_cast<double>(i + 1) / n)});
  }
  return worst;
}

class RandomSeeds : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomSeeds, NormalsFollowTheNormalDistribution) {
  std::vector<float> numbers(200'000);
  fill_normals(random_key({GetParam()}), numbers);
  EXPECT_LT(kolmogorov_distance(numbers), 1.95 / std::sqrt(200'000.0));  // exceeded by chance once in 1000
  const auto beyond = std::ranges::count_if(numbers, [](float x) { return std::fabs(x) > 4.0F; });
  EXPECT_GE(beyond, 2);  // 12.7 expected
  EXPECT_LE(beyond, 30);
}

TEST_P(RandomSeeds, NeighbouringNormalsAreIndependent) {
  std::vector<float> numbers(200'000);
  fill_normals(random_key({GetParam()}), numbers);
  for (const std::size_t lag : {1U, 2U, 64U, 128U}) {
    double sum = 0;
    for (std::size_t i = 0; i + lag < numbers.size(); ++i)
      sum += static_cast<double>(numbers[i]) * static_cast<double>(numbers[i + lag]);
    EXPECT_LT(std::fabs(sum) / 200'000.0, 4.0 / std::sqrt(200'000.0)) << "lag " << lag;
  }
}

TEST_P(RandomSeeds, ACorrelatedFieldKeepsUnitVarianceAndAWindowsCorrelation) {
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  constexpr int kWindow = 5;
  NoiseField field(kWidth, kHeight, kWindow);
  double square = 0;
  std::vector<double> along(10);
  std::vector<double> down(10);
  constexpr int kFrames = 8;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const std::vector<float>& x = field.draw(random_key({GetParam(), frame}));
    for (int v = 0; v + 10 < kHeight; ++v) {
      for (int u = 0; u + 10 < kWidth; ++u) {
        const auto at = [&](int column, int row) {
          return static_cast<double>(x[static_cast<std::size_t>(row * kWidth + column)]);
        };
        square += at(u, v) * at(u, v);
        for (int lag = 1; lag < 10; ++lag) {
          along[static_cast<std::size_t>(lag)] += at(u, v) * at(u + lag, v);
          down[static_cast<std::size_t>(lag)] += at(u, v) * at(u, v + lag);
        }
      }
    }
  }
  EXPECT_NEAR(square / (kFrames * (kWidth - 10) * (kHeight - 10)), 1.0, 0.04);
  for (int lag = 1; lag < 10; ++lag) {
    const double expected = std::max(0.0, 1.0 - static_cast<double>(lag) / kWindow);
    EXPECT_NEAR(along[static_cast<std::size_t>(lag)] / square, expected, 0.04) << lag;
    EXPECT_NEAR(down[static_cast<std::size_t>(lag)] / square, expected, 0.04) << lag;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSeeds, ::testing::Values(1, 2, 3));

TEST(Random, StreamsOfDifferentKeysDiffer) {
  EXPECT_NE(random_key({1, 2}), random_key({2, 1}));
  EXPECT_NE(random_key({1}), random_key({1, 0}));
  EXPECT_NE(random_bits(random_key({1}), 0), random_bits(random_key({1}), 1));
}

TEST(Random, ASubspanIsTheSameAsAStreamOfItsOwnLength) {
  std::vector<float> few(5);
  std::vector<float> many(500);
  fill_normals(7, few);
  fill_normals(7, many);
  EXPECT_TRUE(std::ranges::equal(few, std::span(many).first(5)));
}

TEST(SinCos, AgreesWithTheCLibrary) {
  for (double degrees = -1000; degrees < 1000; degrees += 0.37) {
    const double radians = degrees * 3.14159265358979323846 / 180.0;
    EXPECT_NEAR(sin_cos_deg(degrees).sin, std::sin(radians), 2e-14) << degrees;
    EXPECT_NEAR(sin_cos_deg(degrees).cos, std::cos(radians), 2e-14) << degrees;
  }
  EXPECT_EQ(sin_cos_deg(90).sin, 1.0);
  EXPECT_EQ(sin_cos_deg(90).cos, 0.0);
  EXPECT_EQ(sin_cos_deg(-180).cos, -1.0);
}

}  // namespace
}  // namespace floornav
