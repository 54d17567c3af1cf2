#include <cmath>

#include <gtest/gtest.h>

#include "tools/bench/step_check.hpp"
#include "tools/simulator/surface.hpp"

namespace floornav {
namespace {

/// A map as a perfect stack would make it: the truth's heights, edges closed above 2 cm.
GridMap true_map(const StepCourse& course, double error_m) {
  GridMap map(0.05);
  const Eigen::Vector2d robot = course.T_world_body.translation().head<2>();
  const auto height = [&](CellIndex c) {
    return surface_at(course.shapes, {map.lattice().center_of(c.ix), map.lattice().center_of(c.iy)}).z_m;
  };
  const CellIndex low = map.lattice().cell_of(robot.x() - 7, robot.y() - 7);
  for (std::int32_t iy = low.iy; iy < low.iy + 280; ++iy) {
    for (std::int32_t ix = low.ix; ix < low.ix + 280; ++ix) {
      GridTile& tile = map.make(GridMap::tile_of({ix, iy}));
      const auto i = static_cast<std::size_t>(GridTile::index_of({ix, iy}));
      const double wrong_m = (ix / 4 + iy / 4) % 2 == 0 ? error_m : -error_m;
      tile.state[i] = VertexState::kFree;
      tile.height[i] = static_cast<std::int16_t>(std::lround((height({ix, iy}) + wrong_m) * 1e4));
      for (std::size_t k = 0; k < 8; ++k) {
        const double other = height({ix + kNeighbourX[k], iy + kNeighbourY[k]});
        if (std::fabs(other - height({ix, iy})) <= 0.02) tile.edges[i] |= static_cast<std::uint8_t>(1U << k);
      }
    }
  }
  return map;
}

class StepSeeds : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(StepSeeds, EveryStepIsFoundOnATrueMapAndNoneOnPlainFloor) {
  for (const double height_m : {0.01, 0.05}) {
    const StepCourse course = step_course(height_m, GetParam());
    const GridMap map = true_map(course, 0.0);
    for (const StepEdge& edge : course.edges) EXPECT_TRUE(shows_step(map, edge));
  }
  StepCourse level = step_course(0.01, GetParam());
  level.shapes.blocks.clear();
  const GridMap level_map = true_map(level, 0.0);
  for (const StepEdge& edge : level.edges) EXPECT_FALSE(shows_step(level_map, edge));
  const StepCourse plain = plain_course(GetParam());
  const PlainCheck check = check_plain(true_map(plain, 0.0), plain.shapes.ground);
  EXPECT_GT(check.places, 2000);
  EXPECT_EQ(check.alarms, 0);
}

TEST_P(StepSeeds, AWavyMapOfAPlainFloorRaisesAlarms) {
  const StepCourse plain = plain_course(GetParam());
  const PlainCheck check = check_plain(true_map(plain, 0.004), plain.shapes.ground);
  EXPECT_GT(check.alarms, check.places / 2);
}

TEST_P(StepSeeds, EdgesLieAtTheirDistances) {
  const StepCourse course = step_course(0.03, GetParam());
  const Eigen::Vector2d robot = course.T_world_body.translation().head<2>();
  for (std::size_t i = 0; i < course.edges.size(); ++i) {
    const StepEdge& edge = course.edges[i];
    EXPECT_NEAR((edge.middle_m - robot).norm(), kStepDistances_m[i], 1e-9);
    const double before = surface_at(course.shapes, edge.middle_m - 0.001 * edge.across).z_m;
    const double behind = surface_at(course.shapes, edge.middle_m + 0.001 * edge.across).z_m;
    EXPECT_NEAR(behind - before, edge.rise_m, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, StepSeeds, ::testing::Range<std::uint64_t>(1, 6));

}  // namespace
}  // namespace floornav
