#include "planner/search/grid_search.hpp"

#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

struct Field {
  SearchGrid grid;
  BitGrid bits;
};

Field field_of(const std::vector<std::uint8_t>& passable, std::int32_t side) {
  Field field;
  field.grid.width = field.grid.height = side;
  field.grid.edges = edges_of_passable(passable, side, side);
  field.grid.whole_squares = true;
  project(field.grid, field.bits);
  return field;
}

/// Single blocked cells by chance.
Field scattered_field(std::int32_t side, int percent) {
  std::mt19937 random(1);
  std::vector<std::uint8_t> passable;
  for (std::int32_t i = 0; i < side * side; ++i)
    passable.push_back(static_cast<int>(random() % 100) >= percent ? 1 : 0);
  return field_of(passable, side);
}

/// Walls with doors.
Field rooms(std::int32_t side) {
  std::vector<std::uint8_t> passable;
  for (std::int32_t y = 0; y < side; ++y)
    for (std::int32_t x = 0; x < side; ++x)
      passable.push_back((x % 16 != 15 || y % 16 == 4) && (y % 16 != 15 || x % 16 == 9) ? 1 : 0);
  return field_of(passable, side);
}

using Method = GridSearch::Method;

TEST(GridSearch, TakesJumpPointsAroundWallsAndAStarAmongScatteredCells) {
  const Field walls = rooms(128), light = scattered_field(128, 2), heavy = scattered_field(128, 30);
  EXPECT_EQ(GridSearch::choose(walls.grid, &walls.bits), Method::kJumpPoints);
  EXPECT_EQ(GridSearch::choose(light.grid, &light.bits), Method::kAStar);
  EXPECT_EQ(GridSearch::choose(heavy.grid, &heavy.bits), Method::kAStar);
}

TEST(GridSearch, TakesAStarWhereJumpPointsWouldAnswerAnotherQuestion) {
  Field walls = rooms(128);
  EXPECT_EQ(GridSearch::choose(walls.grid, nullptr), Method::kAStar) << "closed edges";
  walls.grid.weights.assign(walls.grid.edges.size(), 0);
  EXPECT_EQ(GridSearch::choose(walls.grid, &walls.bits), Method::kAStar) << "costs";
}

TEST(GridSearch, FindsTheSameLengthByEitherAndTellsWhatItReached) {
  const Field walls = rooms(128);
  GridSearch search;
  AStar a_star;
  std::vector<GridCell> path;
  const GridCell start{1, 1}, goal{120, 100};
  ASSERT_EQ(search.search(walls.grid, {&walls.bits}, start, goal), SearchOutcome::kFound);
  ASSERT_EQ(search.method(), Method::kJumpPoints);
  search.path(path);
  EXPECT_EQ(path.front(), start);
  EXPECT_EQ(path.back(), goal);
  std::uint32_t cost = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    cost += path[i].x != path[i - 1].x && path[i].y != path[i - 1].y ? kExactSteps.diagonal
                                                                     : kExactSteps.straight;
  ASSERT_EQ(a_star.search(walls.grid, start, goal), SearchOutcome::kFound);
  EXPECT_EQ(cost, a_star.cost_of(goal));
  const GridCell wall{15, 0};
  EXPECT_EQ(search.search(walls.grid, {&walls.bits}, start, wall), SearchOutcome::kNoPath);
  EXPECT_TRUE(search.reached(goal));
  EXPECT_FALSE(search.reached(wall));
}

TEST(BitGrid, CountsAfterChangesAsWhenBuiltAtOnce) {
  std::mt19937 random(2);
  BitGrid edited;
  edited.reset(150, 70);
  for (int n = 0; n < 20000; ++n)
    edited.set({static_cast<std::int32_t>(random() % 150), static_cast<std::int32_t>(random() % 70)},
               random() % 3 != 0);
  BitGrid built;
  built.build(150, 70, [&](GridCell c) { return edited.free(c); });
  EXPECT_EQ(edited.rows().bits, built.rows().bits);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(edited.rows().stops[i], built.rows().stops[i]);
    EXPECT_EQ(edited.columns().stops[i], built.columns().stops[i]);
  }
  EXPECT_DOUBLE_EQ(edited.turns_per_cell(), built.turns_per_cell());
  EXPECT_DOUBLE_EQ(edited.turns_per_border(), built.turns_per_border());
}

}  // namespace
}  // namespace floornav
