#include "perception/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

struct Points {
  std::vector<float> x, y, z;
  void add(float px, float py, float pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
  [[nodiscard]] PointsView view() const { return {x, y, z}; }
};

/// Eq. (6) by comparing every point with every other, in the order of float operations that
/// mean_neighbor_distances states.
std::vector<std::uint8_t> brute_force_keep(const Points& p, int neighbors, double epsilon) {
  const std::size_t n = p.x.size();
  std::vector<float> mean(n, 0.0F);
  for (std::size_t i = 0; i < n && n > 1; ++i) {
    std::vector<float> squared;
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const float dx = p.x[i] - p.x[j], dy = p.y[i] - p.y[j], dz = p.z[i] - p.z[j];
      squared.push_back((dx * dx + dy * dy) + dz * dz);
    }
    const auto count = std::min(squared.size(), static_cast<std::size_t>(neighbors));
    std::partial_sort(squared.begin(), squared.begin() + static_cast<std::ptrdiff_t>(count), squared.end());
    squared.resize(count);
    float sum = 0.0F;
    for (const float s : squared) sum += std::sqrt(s);
    mean[i] = sum / static_cast<float>(squared.size());
  }
  double mu = 0.0, variance = 0.0;
  for (const float m : mean) mu += static_cast<double>(m);
  mu /= static_cast<double>(n);
  for (const float m : mean) variance += (static_cast<double>(m) - mu) * (static_cast<double>(m) - mu);
  const double limit = epsilon * std::sqrt(variance / static_cast<double>(n));
  std::vector<std::uint8_t> keep;
  for (const float m : mean) keep.push_back(std::abs(static_cast<double>(m) - mu) > limit ? 0 : 1);
  return keep;
}

std::vector<std::uint8_t> keep_of(const Points& p, int neighbors, double epsilon,
                                  std::int64_t* outliers = nullptr) {
  std::vector<std::uint8_t> keep(p.x.size(), 7);
  std::vector<std::int32_t> pixel(p.x.size());  // not those of the points: the kd-tree must take them
  std::iota(pixel.begin(), pixel.end(), 0);
  Serial serial;
  OutlierRemover remover({neighbors, epsilon, "auto"});
  const std::int64_t removed = remover.remove({p.view(), pixel, Pinhole{}}, serial, keep);
  if (outliers != nullptr) *outliers = removed;
  return keep;
}

Points random_cloud(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> wide(-1.0F, 1.0F);
  std::normal_distribution<float> thin(0.0F, 0.005F);
  Points p;
  for (int i = 0; i < 900; ++i) p.add(wide(generator), wide(generator), 1.0F + thin(generator));
  for (int i = 0; i < 40; ++i) p.add(wide(generator), wide(generator), 1.0F + wide(generator));
  for (int i = 0; i < 200; ++i) p.add(0.3F + thin(generator), 0.3F + thin(generator), 1.2F + thin(generator));
  return p;
}

class OutliersOfRandomCloud : public testing::TestWithParam<unsigned> {};

TEST_P(OutliersOfRandomCloud, AreThoseOfTheBruteForceOracle) {
  const Points cloud = random_cloud(GetParam());
  for (const int neighbors : {1, 8, 20}) {
    for (const double epsilon : {1.0, 2.0}) {
      const auto expected = brute_force_keep(cloud, neighbors, epsilon);
      ASSERT_GT(std::count(expected.begin(), expected.end(), 0), 0);
      std::int64_t outliers = 0;
      EXPECT_EQ(keep_of(cloud, neighbors, epsilon, &outliers), expected);
      EXPECT_EQ(outliers, std::count(expected.begin(), expected.end(), 0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OutliersOfRandomCloud, testing::Range(0U, 8U));

TEST(Outliers, BothTooFarAndTooCloseAreRemoved) {
  Points p;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) p.add(0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j), 1.0F);
  p.add(0.4F, 0.4F, 1.0F);                                                                  // lonely
  for (int k = 0; k < 10; ++k) p.add(0.1F, 0.1F, 1.0005F + 1e-5F * static_cast<float>(k));  // crowded
  const auto keep = keep_of(p, 8, 1.0);
  EXPECT_EQ(keep[900], 0);
  EXPECT_EQ(keep[905], 0);
  EXPECT_EQ(keep[30 * 15 + 15], 1);
}

TEST(Outliers, FewPointsHaveFewNeighbours) {
  for (int count = 0; count <= 10; ++count) {
    Points p;
    for (int i = 0; i < count; ++i) p.add(0.01F * static_cast<float>(i * i), 0.0F, 1.0F);
    EXPECT_EQ(keep_of(p, 8, 1.0), brute_force_keep(p, 8, 1.0)) << count << " points";
  }
}

TEST(Outliers, IdenticalPointsAreKeptAndDoNotHang) {
  Points p;
  for (int i = 0; i < 200'000; ++i) p.add(1.0F, 2.0F, 3.0F);
  const auto keep = keep_of(p, 8, 2.0);
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 1), 200'000);
}

TEST(Outliers, ManyIdenticalPointsAmongOthersDoNotHang) {
  Points p = random_cloud(3);
  for (int i = 0; i < 1000; ++i) p.add(0.5F, 0.5F, 1.0F);
  EXPECT_EQ(keep_of(p, 8, 2.0), brute_force_keep(p, 8, 2.0));
  for (int i = 0; i < 100'000; ++i) p.add(0.5F, 0.5F, 1.0F);
  EXPECT_EQ(keep_of(p, 8, 2.0).size(), p.x.size());
}

}  // namespace
}  // namespace floornav
