#include "planner/planning_grid.hpp"

#include <random>

#include <gtest/gtest.h>

#include "map_drawing.hpp"

namespace floornav {
namespace {

RobotSettings small_robot(double radius_m) {
  RobotSettings robot;
  robot.radius_m = radius_m;
  return robot;
}

class PlanningGridOfSeed : public testing::TestWithParam<unsigned> {};

TEST_P(PlanningGridOfSeed, AfterEditsEqualsOneMadeAfresh) {
  std::mt19937 random(GetParam());
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  GridMap map = random_map(random, 60, 0.05, true);
  const RobotSettings robot = small_robot(0.05 * uniform(1, 9));
  const CellRect needed{-70, -70, 70, 70};
  const AssumedFloor assumed{0.1, -0.3, 0.9};
  PlanningGrid followed({}, robot);
  followed.update(map, needed, assumed);
  for (int edit = 0; edit < 8; ++edit) {
    map.version += 1;
    for (int n = uniform(1, 30); n > 0; --n)
      set_cell(map, {uniform(-60, 59), uniform(-60, 59)}, static_cast<VertexState>(uniform(0, 2)));
    if (uniform(0, 3) == 0) map.erase({uniform(-2, 1), uniform(-2, 1)});
    followed.update(map, needed, assumed);
    PlanningGrid afresh({}, robot);
    afresh.update(map, needed, assumed);
    ASSERT_EQ(followed.search_grid().edges, afresh.search_grid().edges) << "edit " << edit;
    ASSERT_EQ(followed.search_grid().weights, afresh.search_grid().weights) << "edit " << edit;
    ASSERT_EQ(*followed.aids().blocks, block_weights(followed.search_grid())) << "edit " << edit;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlanningGridOfSeed, testing::Range(0U, 12U));

TEST(PlanningGrid, StartsAfreshForAMapWhoseVersionWentBack) {
  GridMap old_map = draw_map(std::vector<std::string>(20, std::string(20, '.')), 0.1);
  old_map.version = 7;
  PlanningGrid grid({}, small_robot(0.1));
  grid.update(old_map, {0, 0, 20, 20}, {});
  ASSERT_TRUE(grid.passable(grid.cell_of(1.0, 1.0)));
  GridMap new_map = draw_map(std::vector<std::string>(20, std::string(20, '#')), 0.1);
  grid.update(new_map, {0, 0, 20, 20}, {});
  EXPECT_FALSE(grid.passable(grid.cell_of(1.0, 1.0)));
}

TEST(PlanningGrid, UnknownIsPassableButNeverFreeAndWeighsMore) {
  std::vector<std::string> rows(40, std::string(20, '.') + std::string(20, ' '));
  const GridMap map = draw_map(rows, 0.1);
  PlanningGrid grid({}, small_robot(0.2));
  grid.update(map, {0, 0, 40, 40}, {});
  const GridCell known = grid.cell_of(1.0, 2.0), unknown = grid.cell_of(3.0, 2.0),
                 edge = grid.cell_of(1.85, 2.0);
  EXPECT_TRUE(grid.known_free(known));
  EXPECT_TRUE(grid.passable(unknown));
  EXPECT_FALSE(grid.known_free(unknown));
  EXPECT_EQ(grid.floor(edge), Floor::kFree);
  EXPECT_FALSE(grid.known_free(edge)) << "the robot's circle would reach over unknown floor";
  const auto& weights = grid.search_grid().weights;
  EXPECT_EQ(weights[grid.search_grid().index(known)], 0);
  EXPECT_EQ(weights[grid.search_grid().index(unknown)], 96);  // unknown_cost 3 of 32 each
}

TEST(PlanningGrid, AssumesFloorWhereNothingWasSeenOnly) {
  std::vector<std::string> rows(40, std::string(40, ' '));
  rows[20][25] = '#';
  const GridMap map = draw_map(rows, 0.1);
  PlanningGrid grid({}, small_robot(0.2));
  grid.update(map, {0, 0, 40, 40}, {2.05, 2.05, 1.0});
  EXPECT_EQ(grid.floor(grid.cell_of(2.05, 2.05)), Floor::kAssumed);
  EXPECT_TRUE(grid.known_free(grid.cell_of(2.05, 2.05)));
  EXPECT_EQ(grid.floor(grid.cell_of(2.55, 2.05)), Floor::kBlocked);
  EXPECT_EQ(grid.floor(grid.cell_of(3.35, 2.05)), Floor::kUnknown);
}

TEST(PlanningGrid, RefusesCellsTooSmallForTheRobot) {
  GridMap map(0.01);
  PlanningGrid grid({}, small_robot(1.0));
  EXPECT_THROW(grid.update(map, {0, 0, 10, 10}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace floornav
