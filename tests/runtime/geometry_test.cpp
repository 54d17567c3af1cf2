#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <unordered_set>

#include <gtest/gtest.h>

#include "runtime/geometry/lattice.hpp"
#include "runtime/geometry/pinhole.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/geometry/pose_history.hpp"

namespace floornav {
namespace {

constexpr double kPi = std::numbers::pi;

Pose yawed(double x, double y, double yaw) {
  Pose pose = Pose::Identity();
  pose.translate(Eigen::Vector3d(x, y, 0.0)).rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  return pose;
}

class Yaw : public testing::TestWithParam<double> {};

TEST_P(Yaw, IsInterpolatedInProportion) {
  const double yaw = GetParam();
  for (double fraction = 0.0; fraction <= 1.0; fraction += 0.125) {
    const Pose pose = interpolate(yawed(1, 2, 0.3), yawed(3, -2, 0.3 + yaw), fraction);
    EXPECT_NEAR(heading_of(pose), std::remainder(0.3 + fraction * yaw, 2 * kPi), 1e-12);
    EXPECT_NEAR(pose.translation().x(), 1 + 2 * fraction, 1e-12);
    EXPECT_NEAR(pose.translation().y(), 2 - 4 * fraction, 1e-12);
    EXPECT_TRUE((pose.linear() * pose.linear().transpose()).isIdentity(1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, Yaw, testing::Values(0.0, 1e-9, 0.1, 1.5, -1.5, 3.1, -3.1));

TEST(Interpolate, TakesTheShortWayAcrossTheBackOfTheCircle) {
  const Pose pose = interpolate(yawed(0, 0, kPi - 0.1), yawed(0, 0, -kPi + 0.1), 0.5);
  EXPECT_NEAR(std::abs(heading_of(pose)), kPi, 1e-12);
}

TEST(Interpolate, TurnsAboutAnyAxisAtConstantRate) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 3).normalized();
  Pose end = Pose::Identity();
  end.rotate(Eigen::AngleAxisd(2.0, axis));
  for (const double fraction : {0.0, 0.25, 0.6, 1.0}) {
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(2.0 * fraction, axis).toRotationMatrix();
    EXPECT_TRUE(interpolate(Pose::Identity(), end, fraction).linear().isApprox(expected, 1e-12));
  }
}

TEST(PoseArrays, FollowTheWrittenOutRotation) {
  // 90 degrees about z: x becomes y. Twice the length: normalised.
  const double position[3] = {1, 2, 3};
  const double quaternion[4] = {2 * std::sqrt(0.5), 0, 0, 2 * std::sqrt(0.5)};
  const Pose pose = pose_from_arrays(position, quaternion);
  EXPECT_TRUE((pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3), 1e-12));
  EXPECT_NEAR(heading_of(pose), kPi / 2, 1e-12);
  double position_again[3];
  double quaternion_again[4];
  pose_to_arrays(pose, position_again, quaternion_again);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(position_again[i], position[i]);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(quaternion_again[i], quaternion[i] / 2, 1e-12);
}

TEST(PoseArrays, RefuseWhatIsNoPose) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const double huge = std::numeric_limits<double>::max();
  const double fine[3] = {0, 0, 0};
  for (const auto& q : {std::array{0.0, 0.0, 0.0, 0.0}, std::array{nan, 0.0, 0.0, 1.0},
                        std::array{inf, 0.0, 0.0, 0.0}, std::array{huge, huge, 0.0, 0.0}})
    EXPECT_THROW(pose_from_arrays(fine, q.data()), std::invalid_argument);
  const double one[4] = {1, 0, 0, 0};
  for (const auto& p : {std::array{nan, 0.0, 0.0}, std::array{0.0, -inf, 0.0}})
    EXPECT_THROW(pose_from_arrays(p.data(), one), std::invalid_argument);
}

TEST(PoseHistory, InterpolatesBetweenTheTwoThatBracketATime) {
  PoseHistory history;
  EXPECT_FALSE(history.at(0));
  EXPECT_FALSE(history.newest());
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(history.insert(1000 + 100 * i, yawed(i, 0, 0.1 * i)));
  EXPECT_FALSE(history.at(999));
  EXPECT_FALSE(history.at(1901));
  for (const int utime : {1000, 1001, 1050, 1100, 1833, 1900}) {
    const std::optional<Pose> pose = history.at(utime);
    ASSERT_TRUE(pose) << utime;
    EXPECT_NEAR(pose->translation().x(), (utime - 1000) / 100.0, 1e-12) << utime;
    EXPECT_NEAR(heading_of(*pose), (utime - 1000) / 1000.0, 1e-12) << utime;
  }
  EXPECT_EQ(history.newest_utime(), 1900);
}

TEST(PoseHistory, TakesNothingOlderThanTheNewest) {
  PoseHistory history;
  EXPECT_TRUE(history.insert(100, yawed(1, 0, 0)));
  EXPECT_FALSE(history.insert(100, yawed(2, 0, 0)));
  EXPECT_FALSE(history.insert(50, yawed(3, 0, 0)));
  EXPECT_EQ(history.newest()->translation().x(), 1.0);
  EXPECT_FALSE(history.at(50));
  history.clear();
  EXPECT_TRUE(history.insert(50, yawed(3, 0, 0)));
}

TEST(PoseHistory, ForgetsWhatIsOlderThanItsSpan) {
  PoseHistory history(1000);
  for (int utime = 0; utime <= 5000; utime += 100) history.insert(utime, yawed(utime, 0, 0));
  EXPECT_FALSE(history.at(3999));
  EXPECT_TRUE(history.at(4000));
}

TEST(PoseHistory, SurvivesExtremeTimes) {
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  PoseHistory history;
  EXPECT_TRUE(history.insert(kMin, yawed(0, 0, 0)));
  EXPECT_TRUE(history.insert(kMax, yawed(1, 0, 0)));
  EXPECT_FALSE(history.at(0));  // the first one is older than the span
  EXPECT_TRUE(history.at(kMax));
}

TEST(Lattice, CoversNegativeCoordinatesWithoutACellTwiceAsWide) {
  const Lattice lattice{0.05};
  EXPECT_EQ(lattice.index_of(0.0), 0);
  EXPECT_EQ(lattice.index_of(0.049), 0);
  EXPECT_EQ(lattice.index_of(-0.001), -1);
  EXPECT_EQ(lattice.index_of(-0.051), -2);
  EXPECT_EQ(lattice.cell_of(0.12, -0.12), (CellIndex{2, -3}));
  for (int i = -1000; i <= 1000; ++i) EXPECT_EQ(lattice.index_of(lattice.center_of(i)), i);
}

TEST(Lattice, ClampsWhatNoIndexCanHold) {
  const Lattice lattice{0.05};
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(lattice.index_of(1e30), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(lattice.index_of(inf), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(lattice.index_of(-1e30), std::numeric_limits<std::int32_t>::min());
}

TEST(BlockOf, RoundsTowardsMinusInfinity) {
  for (const int size : {1, 2, 7, 64}) {
    for (int index = -500; index <= 500; ++index)
      EXPECT_EQ(block_of(index, size), static_cast<int>(std::floor(static_cast<double>(index) / size)))
          << index << "/" << size;
  }
  EXPECT_EQ(block_of(std::numeric_limits<std::int32_t>::min(), 64),
            std::numeric_limits<std::int32_t>::min() / 64);
}

TEST(CellIndexHash, TellsNeighboursApart) {
  std::unordered_set<std::size_t> hashes;
  for (int ix = -50; ix < 50; ++ix) {
    for (int iy = -50; iy < 50; ++iy) hashes.insert(std::hash<CellIndex>{}({ix, iy}));
  }
  EXPECT_EQ(hashes.size(), 10'000U);
}

TEST(Pinhole, ProjectsAPointOntoThePixelWhoseRayItIsOn) {
  const Pinhole camera;
  EXPECT_TRUE(camera.ray(camera.cx, camera.cy).isApprox(Eigen::Vector3f(0, 0, 1)));
  EXPECT_TRUE(
      camera.project({1.0F, -0.5F, 2.0F}).isApprox(Eigen::Vector2f(319.5F + 262.5F, 239.5F - 131.25F)));
  for (const float u : {0.0F, 100.0F, 639.0F}) {
    const Eigen::Vector2f pixel = camera.project(camera.ray(u, 300.0F) * 3.5F);
    EXPECT_NEAR(pixel.x(), u, 1e-3F);
    EXPECT_NEAR(pixel.y(), 300.0F, 1e-3F);
  }
}

}  // namespace
}  // namespace floornav
