#include "perception/cell_rise.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "perception/noise_correlation.hpp"

namespace floornav {
namespace {

constexpr int kSide = 21;
constexpr float kNoise_m = 0.004F;  ///< 1 sigma of a cell's mean
constexpr int kPoints = 16;

/// A window of 21 x 21 cells on one plane, each with the mean that `height` gives it.
class Patch {
 public:
  template <class Height>
  explicit Patch(const Height& height) : rises_(kSide * kSide) {
    RoiSettings roi;
    roi.x_min_m = roi.y_min_m = 0.025;
    roi.x_max_m = roi.y_max_m = 0.05 * (kSide - 1) + 0.025;
    window_ = CellWindow(Lattice{}, roi, Pose::Identity());
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        rises_[static_cast<std::size_t>(y * kSide + x)] = {CellRise::kFloor, kPoints, kPoints * height(x, y),
                                                           kPoints * kPoints * kNoise_m * kNoise_m, 0.0F};
  }

  [[nodiscard]] bool fits() const { return window_.size_x() == kSide && window_.size_y() == kSide; }
  [[nodiscard]] float significant(int x, int y, const CellNoise& noise) const {
    return significant_rise(rises_, window_, y * kSide + x, 2.5F, noise);
  }

 private:
  CellWindow window_;
  std::vector<CellRise> rises_;
};

TEST(CellRise, AWideStepShowsThoughNoCellCouldTellIt) {
  const Patch patch([](int x, int) { return x < 10 ? 0.0F : 0.008F; });  // 2 sigma of a cell
  ASSERT_TRUE(patch.fits());
  EXPECT_LT(patch.significant(4, 10, {}), 0.001F);
  EXPECT_GT(patch.significant(16, 10, {}), 0.006F);
}

TEST(CellRise, ASingleCellLeavesItsPlaneOnlyWhereItIsSure) {
  const auto spike = [](float height_m) {
    return Patch([height_m](int x, int y) { return x == 10 && y == 10 ? height_m : 0.0F; });
  };
  EXPECT_LT(spike(0.008F).significant(10, 10, {}), 0.001F);
  EXPECT_GT(spike(0.05F).significant(10, 10, {}), 0.04F);
}

TEST(CellRise, WhatErrsAlikeCountsOnce) {
  const Patch patch([](int, int) { return 0.008F; });
  EXPECT_GT(patch.significant(10, 10, {.width_px = 4.0F, .alike_px = 1.0F}), 0.006F);
  // as wide as the whole patch: one measurement, whose sigma is 4 times that of a cell's mean
  EXPECT_EQ(patch.significant(10, 10, {.width_px = 4.0F, .alike_px = 100.0F}), 0.0F);
}

TEST(CellRise, CellsOfAnotherPlaneDoNotCount) {
  std::vector<CellRise> rises(9);
  for (std::size_t i = 0; i < rises.size(); ++i)
    rises[i] = {static_cast<std::int16_t>(i % 3), kPoints, kPoints * (i % 3 == 0 ? 0.0F : 1.0F), 1e-6F, 0.0F};
  RoiSettings roi;
  roi.x_min_m = roi.y_min_m = 0.025;
  roi.x_max_m = roi.y_max_m = 0.125;
  EXPECT_EQ(significant_rise(rises, CellWindow(Lattice{}, roi, Pose::Identity()), 3, 2.5F, {}), 0.0F);
}

/// A floor of 400 x 100 pixels whose noise is the mean over n neighbours of a row.
class FloorNoise : public ::testing::TestWithParam<int> {};

TEST_P(FloorNoise, IsAlikeOverTheWindowThatMadeIt) {
  constexpr int kWidth = 400, kHeight = 100;
  const int window = GetParam();
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  RoiCloud cloud;
  for (int v = 0; v < kHeight; ++v) {
    std::vector<float> white(static_cast<std::size_t>(kWidth + window));
    for (float& x : white) x = normal(random);
    for (int u = 0; u < kWidth; ++u) {
      float sum = 0.0F;
      for (int k = 0; k < window; ++k) sum += white[static_cast<std::size_t>(u + k)];
      cloud.ray_x.push_back(0.0F);
      cloud.ray_y.push_back(0.0F);
      cloud.inverse_depth.push_back(0.5F + 0.01F * sum / std::sqrt(static_cast<float>(window)));
      cloud.certainty.push_back(100.0F);
      cloud.pixel.push_back(v * kWidth + u);
    }
  }
  cloud.x.resize(cloud.pixel.size());
  cloud.section_end = {kWidth * kHeight};
  std::vector<SectionResult> sections(1);
  sections[0].planes.push_back({{0.0F, 0.0F, 0.5F}, {}, true});
  const std::vector<std::int16_t> label(cloud.pixel.size(), 0);
  NoiseCorrelation noise;
  Serial serial;
  noise.measure(0, 1, cloud, label, sections, serial);
  EXPECT_NEAR(noise.alike_px(), window, 0.2 * window);
  noise.clear();
  sections[0].planes.front().dominant = false;
  noise.measure(0, 1, cloud, label, sections, serial);
  EXPECT_EQ(noise.alike_px(), 1.0F) << "no floor, nothing known";
}

INSTANTIATE_TEST_SUITE_P(Windows, FloorNoise, ::testing::Values(1, 5, 9, 15));

}  // namespace
}  // namespace floornav
