#include "perception/top_edge.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr double kPitch_m = 0.05;

Surfel surfel(const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal) {
  return {.centroid_m = centroid, .normal = normal.normalized().cast<float>(), .radius_m = 0.15F};
}

class TopEdge : public testing::TestWithParam<unsigned> {};

/// Two random planes, and the brute force: the highest of many places of the cell that lie on both.
TEST_P(TopEdge, IsTheHighestPlaceOfTheCellOnBothPlanes) {
  std::mt19937 random(GetParam());
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector2d middle(uniform(-3, 3), uniform(-3, 3));
    const Eigen::Vector3d on_both(middle.x() + uniform(-0.02, 0.02), middle.y() + uniform(-0.02, 0.02), 0.3);
    const Eigen::Vector3d side_normal(uniform(-1, 1), uniform(0.3, 1), uniform(-0.1, 0.3));
    const Eigen::Vector3d top_normal(uniform(-0.4, 0.4), uniform(-0.4, 0.4), 1.0);
    double highest = -1e9;
    for (int i = -500; i <= 500; ++i)
      for (const bool along_x : {true, false}) {
        // on each line x = const (or y = const) of the cell there is one place on both planes
        const double fixed = i * kPitch_m / 1000.0;
        Eigen::Matrix2d A;
        const int free_axis = along_x ? 1 : 0;
        const int fixed_axis = along_x ? 0 : 1;
        A << side_normal[free_axis], side_normal.z(), top_normal[free_axis], top_normal.z();
        const double shift = middle[fixed_axis] + fixed - on_both[fixed_axis];
        const Eigen::Vector2d b(-side_normal[fixed_axis] * shift, -top_normal[fixed_axis] * shift);
        const Eigen::Vector2d found = A.inverse() * b;
        if (std::abs(on_both[free_axis] + found.x() - middle[free_axis]) > 0.5 * kPitch_m) continue;
        highest = std::max(highest, on_both.z() + found.y());
      }
    const auto edge = edge_z_m(surfel(on_both, side_normal), surfel(on_both, top_normal), middle, kPitch_m);
    ASSERT_TRUE(edge);
    EXPECT_NEAR(*edge, highest, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, TopEdge, testing::Range(1U, 4U));

TEST(TopEdge, IsNothingFarFromTheCellOrBetweenParallelPlanes) {
  const Surfel side = surfel({1, 0, 0.1}, {-1, 0, 0});
  const Surfel top = surfel({1.1, 0, 0.2}, {0, 0, 1});
  EXPECT_TRUE(edge_z_m(side, top, {1.03, 0.0}, kPitch_m));
  EXPECT_FALSE(edge_z_m(side, top, {1.2, 0.0}, kPitch_m));
  EXPECT_FALSE(edge_z_m(top, surfel({1.1, 0, 0.4}, {0, 0, 1}), {1.1, 0.0}, kPitch_m));
}

/// Its side is x = 1, its top rises with x: 0.2 m there, 0.25 m at 1.1 m.
TEST(TopEdge, BesideACellCountsWhereTheCellIsNextToIt) {
  const Surfel side = surfel({1, 0, 0.1}, {-1, 0, 0});
  const Surfel top = surfel({1, 0, 0.2}, {-0.5, 0, 1});
  EXPECT_NEAR(*edge_z_m(side, top, {1.0, 0.0}, kPitch_m), 0.2, 1e-5);
  EXPECT_NEAR(*edge_z_m(side, top, {1.04, 0.0}, kPitch_m), 0.2075, 1e-5);
}

/// A box of 0.2 m: its side x = 1, its top behind.
class BoxEdge : public testing::Test {
 protected:
  BoxEdge() {
    evidence.lattice.pitch_m = kPitch_m;
    evidence.surfels = {surfel({1, 0, 0.1}, {-1, 0, 0}), surfel({1.15, 0, 0.2}, {0, 0, 1})};
    cell.cell = evidence.lattice.cell_of(1.0, 0.0);
    cell.surfel = 0;
  }
  [[nodiscard]] std::optional<float> top(float top_z_m) const {
    return edge_with_top_z_m(top_z_m, 0.01F, cell, SensorView(DepthFrame{}, Pose::Identity()), evidence);
  }
  FloorEvidence evidence;
  CellEvidence cell;
};

TEST_F(BoxEdge, EndsASideWhereTheTopBegins) {
  EXPECT_FLOAT_EQ(top(0.208F).value_or(0), 0.2F);
}

TEST_F(BoxEdge, LeavesWhatIsLowerOrRisesClearlyAboveTheTop) {
  EXPECT_FALSE(top(0.15F));
  EXPECT_FALSE(top(0.22F));
}

TEST_F(BoxEdge, LeavesASideBesideWhichThereIsOnlyFloorOrATopFarAway) {
  evidence.surfels[1].dominant = true;
  EXPECT_FALSE(top(0.208F));
  evidence.surfels[1] = surfel({3.0, 0, 0.2}, {0, 0, 1});
  EXPECT_FALSE(top(0.208F));
}

}  // namespace
}  // namespace floornav
