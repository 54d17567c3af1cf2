#include "perception/cell_evidence.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr float kVar_m2 = 1e-4F;  // 1 cm, as far floor has it

CellEvidence summarized(const std::vector<CellPoint>& points) {
  CellScratch scratch;
  CellEvidence cell;
  summarize_cell(points, find_deciding_surfel(points, 2, scratch), 0.0F, scratch, cell);
  return cell;
}

CellPoint on_floor(float rise_m) {
  return {0, 0.0F, rise_m, kVar_m2, 0.0F};
}
CellPoint on_nothing(float z_m) {
  return {-1, z_m, 0.0F, kVar_m2, 0.0F};
}

TEST(CellEvidence, ASinglePointOnTheFloorIsFloor) {
  const CellEvidence cell = summarized({on_floor(0.005F)});
  EXPECT_EQ(cell.surfel, 0);
  EXPECT_NEAR(cell.mean_z_m, 0.0F, 1e-6F);
  EXPECT_NEAR(cell.top_z_m, 0.0F, 1e-6F);
}

TEST(CellEvidence, FloorWithOnePointOfNoiseBesideItIsFloor) {
  EXPECT_EQ(summarized({on_floor(0.0F), on_nothing(0.03F)}).surfel, 0);
  EXPECT_EQ(summarized({on_nothing(-0.03F), on_floor(0.0F)}).surfel, 0);
}

TEST(CellEvidence, WhatStandsAboveASinglePointOfFloorDecides) {
  const CellEvidence cell = summarized({on_floor(0.0F), on_nothing(0.3F)});
  EXPECT_EQ(cell.surfel, -1);
  EXPECT_GE(cell.top_z_m, 0.0F);
  EXPECT_EQ(summarized({on_nothing(0.3F)}).surfel, -1);
}

TEST(CellEvidence, OneOfManyPointsOnASurfelIsNotEnough) {
  EXPECT_EQ(summarized({on_floor(0.0F), on_nothing(0.01F), on_nothing(0.02F)}).surfel, -1);
}

TEST(CellEvidence, TheHighestSurfelWithAShareDecides) {
  std::vector<CellPoint> points(20, on_floor(0.0F));
  for (int i = 0; i < 3; ++i) points.push_back({1, 0.2F, 0.0F, kVar_m2, 0.0F});
  EXPECT_EQ(summarized(points).surfel, 1);
  points.pop_back();
  points.pop_back();
  EXPECT_EQ(summarized(points).surfel, 0);
}

/// 400 points of 1 cm of noise on what is level: their tenth highest are 1.3 cm too high.
TEST(CellEvidence, TopOfWhatIsLevelIsItsMeanWithAPlaneOrWithout) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.2F, std::sqrt(kVar_m2));
  std::vector<CellPoint> points;
  for (int i = 0; i < 400; ++i) points.push_back(on_nothing(noise(random)));
  EXPECT_NEAR(summarized(points).top_z_m, 0.2F, 0.004F);
  for (CellPoint& point : points) point.surfel = 1;
  CellScratch scratch;
  DecidingSurfel decider = find_deciding_surfel(points, 2, scratch);
  decider.slanted = true;
  CellEvidence cell;
  summarize_cell(points, decider, 0.0F, scratch, cell);
  EXPECT_NEAR(cell.top_z_m, 0.2F, 0.004F);
}

TEST(CellEvidence, TopOfAThingOnNoPlaneIsNearItsUpperEnd) {
  std::vector<CellPoint> points;
  for (int i = 0; i < 100; ++i) points.push_back(on_nothing(0.003F * static_cast<float>(i)));
  const float top_m = summarized(points).top_z_m;
  EXPECT_GT(top_m, 0.26F);
  EXPECT_LE(top_m, 0.3F);
}

}  // namespace
}  // namespace floornav
