#include "tools/bench/table1.hpp"

#include <gtest/gtest.h>

#include "tools/simulator/surface.hpp"

namespace floornav {
namespace {

TEST(HeightErrors, AMissedObstacleCountsWithItsFullHeight) {
  HeightErrors errors;
  errors.add(0.30, 0.31);
  errors.add(0.02, 0.20);  // less than half of it was seen
  EXPECT_EQ(errors.count, 2);
  EXPECT_EQ(errors.missed, 1);
  EXPECT_NEAR(errors.mean_cm(), (1.0 + 20.0) / 2.0, 1e-9);
  EXPECT_NEAR(errors.worst_m, 0.20, 1e-12);
}

class Courses : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Courses, HaveThreeObstaclesNearAndThreeFarWithTheirTrueHeights) {
  const SensorSpec sensor = kinect(320);
  const ObstacleCourse course = random_course(sensor, {5.5, 3.0}, GetParam());
  int near = 0;
  ASSERT_EQ(course.obstacles.size(), 6U);
  for (const Obstacle& obstacle : course.obstacles) {
    if (obstacle.distance_m < 3.0) ++near;
    EXPECT_LE(obstacle.distance_m, 5.5);
    double highest = 0;
    for (int i = -50; i <= 50; ++i) {
      for (int j = -50; j <= 50; ++j) {
        const Eigen::Vector2d local(0.0199 * i * obstacle.footprint.half_m.x(),
                                    0.0199 * j * obstacle.footprint.half_m.y());
        highest = std::max(highest, surface_at(course.shapes, obstacle.footprint.world(local)).z_m);
      }
    }
    EXPECT_NEAR(highest, obstacle.height_m, 0.005);
  }
  EXPECT_EQ(near, 3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Courses, ::testing::Range<std::uint64_t>(1, 5));

TEST(Table1, ThePapersRowsAreThePapers) {
  EXPECT_EQ(paper_row(SensorKind::kKinect, 4, 3).near_cm, 0.44);
  EXPECT_EQ(paper_row(SensorKind::kBumblebee, 12, 9).far_cm, 1.99);
}

}  // namespace
}  // namespace floornav
