#include "mapping/evidence_reader.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "mapping/cell_memory.hpp"

namespace floornav {
namespace {

constexpr float kViewSigma_m = 0.01F;
constexpr float kMaxStep_m = 0.02F;

/// A cell of level floor, of `points` points, with something on it; as far from the sensor as one point's
/// noise says, and with 1 mm that all points have in common.
FloorEvidence floor_with(float top_m, std::int32_t points, float point_sigma_m) {
  FloorEvidence evidence;
  evidence.lattice.pitch_m = 0.05;
  Surfel floor;
  floor.centroid_m.setZero();
  floor.normal = Eigen::Vector3f::UnitZ();
  floor.dominant = true;
  evidence.surfels.push_back(floor);
  CellEvidence cell;
  cell.surfel = 0;
  cell.points = points;
  cell.mean_z_m = 0.0F;
  cell.top_z_m = top_m;
  cell.var_z_m2 = point_sigma_m * point_sigma_m / static_cast<float>(points) + 1e-6F;
  evidence.cells.push_back(cell);
  return evidence;
}

std::vector<Sighting> sightings_of(const FloorEvidence& evidence) {
  std::vector<Sighting> sightings;
  EvidenceReader(kViewSigma_m * kViewSigma_m, kMaxStep_m)
      .read(evidence.cells[0], evidence, Coverage::kWhole, sightings);
  return sightings;
}

class CellWithManyPoints : public testing::TestWithParam<std::int32_t> {};

/// A bracket of 4.8 cm that covers half of a near cell: the more points see it the surer it is.
TEST_P(CellWithManyPoints, ShowsWhatStandsOnItsFloor) {
  const auto sightings = sightings_of(floor_with(0.048F, GetParam(), 0.002F));
  ASSERT_EQ(sightings.size(), 2U);
  EXPECT_FALSE(sightings[0].column);
  EXPECT_TRUE(sightings[1].column);
  EXPECT_FLOAT_EQ(sightings[1].z_m, 0.048F);
}

INSTANTIATE_TEST_SUITE_P(Points, CellWithManyPoints, testing::Values(10, 40, 200, 1000, 5000));

TEST(EvidenceReader, FarNoiseDoesNotStandOut) {
  EXPECT_EQ(sightings_of(floor_with(0.048F, 10, 0.02F)).size(), 1U);
}

/// A top that rises by 0.4 along x: its cell's corner is 1 cm above its middle.
TEST(EvidenceReader, ToldIsHowFarUpItsSlopeAPlaneWasSeen) {
  FloorEvidence evidence = floor_with(0.0F, 10, 0.002F);
  evidence.surfels[0].normal = Eigen::Vector3f(-0.4F, 0.0F, 1.0F).normalized();
  for (const int part : {-Surface::kCorner, -1, 0, 2, Surface::kCorner}) {
    evidence.cells[0].top_z_m = 0.01F * static_cast<float>(part) / Surface::kCorner;
    EXPECT_EQ(sightings_of(evidence).at(0).reach, part);
  }
  evidence.cells[0].top_z_m = 0.02F;
  EXPECT_EQ(sightings_of(evidence).at(0).reach, Surface::kCorner);
  evidence.surfels[0].normal = Eigen::Vector3f::UnitZ();
  EXPECT_EQ(sightings_of(evidence).at(0).reach, 0);
}

/// However uncertain the body's height is: both were seen from the same place.
TEST(EvidenceReader, WhatStandsOutOfAPlaneIsNotPartOfIt) {
  const auto sightings = sightings_of(floor_with(0.035F, 500, 0.002F));
  CellMemory memory;
  memory.fuse({.sightings = sightings}, {.gate_m = 0.01F, .ray_margin_m = 0.02F, .memory_var_m2 = 1e-8F});
  ASSERT_NE(memory.decider(), nullptr);
  EXPECT_TRUE(memory.decider()->column);
  EXPECT_FLOAT_EQ(memory.decider()->z_m, 0.035F);
}

}  // namespace
}  // namespace floornav
