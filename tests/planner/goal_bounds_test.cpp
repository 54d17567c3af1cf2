#include "planner/search/goal_bounds.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "planner/search/a_star.hpp"
#include "tests/planner/random_grid.hpp"

namespace floornav {
namespace {

template <class Visit>
void visit_cells(const SearchGrid& grid, const Visit& visit) {
  for (std::int32_t y = 0; y < grid.height; ++y)
    for (std::int32_t x = 0; x < grid.width; ++x) visit(GridCell{x, y});
}

TEST(GoalBounds, AreConsistentAlongEveryStepAndTellOfNoWayOnlyWhereThereIsNone) {
  GoalBounds bounds;
  int shut_off = 0, close = 0, cells = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    const RandomGrid r = random_grid(seed, seed % 2 == 0 ? 1 : 12);
    const BlockWeights blocks = block_weights(r.grid);
    bounds.begin(blocks, r.grid.steps, r.goal);
    ASSERT_EQ(bounds(r.goal), 0U);
    const auto truth = dijkstra(r.grid, r.goal);  // edges are open both ways
    visit_cells(r.grid, [&](GridCell from) {
      const std::uint64_t way = truth[r.grid.index(from)];
      if (way == UINT64_MAX) return;
      ASSERT_FALSE(bounds.shut_off(from)) << "seed " << seed;
      ++cells;
      close += 10 * std::uint64_t{bounds(from)} >= 6 * way ? 1 : 0;
      for (unsigned open = r.grid.edges[r.grid.index(from)]; open != 0; open &= open - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(open));
        ASSERT_LE(bounds(from), step_cost(r.grid, from, k) + bounds({from.x + kStepX[k], from.y + kStepY[k]}))
            << "seed " << seed << " at " << from.x << "," << from.y;
      }
    });
    visit_cells(r.grid, [&](GridCell cell) { shut_off += bounds.shut_off(cell) ? 1 : 0; });
  }
  EXPECT_GT(shut_off, 1000);
  EXPECT_GT(close, cells / 10);
}

TEST(GoalBounds, KeepASearchThatMustGoAroundAWallFromLookingEverywhere) {
  constexpr std::int32_t kSide = 400, kWall = 194, kDoor = 380;
  SearchGrid grid = empty_grid(kSide);
  std::vector<std::uint8_t> passable;
  visit_cells(grid, [&](GridCell c) {
    const std::int32_t off = std::max({kWall - c.x, c.x - kWall - 11, c.y < kDoor ? 0 : 20});
    passable.push_back(off > 0 ? 1 : 0);
    grid.weights[grid.index(c)] = static_cast<std::uint8_t>(std::clamp(70 - 10 * off, 0, 60));
  });
  grid.edges = edges_of_passable(passable, kSide, kSide);
  const BlockWeights blocks = block_weights(grid);
  AStar a_star;
  const GridCell start{180, 20}, goal{220, 20};
  ASSERT_EQ(a_star.search(grid, start, goal), SearchOutcome::kFound);
  const std::int64_t without = a_star.expanded();
  ASSERT_EQ(a_star.search(grid, start, goal, {}, &blocks), SearchOutcome::kFound);
  EXPECT_LT(2 * a_star.expanded(), without);
}

TEST(GoalBounds, GiveUpWhenTold) {
  const SearchGrid grid = empty_grid(400);
  const BlockWeights blocks = block_weights(grid);
  AStar a_star;
  int asked = 0;
  EXPECT_EQ(a_star.search(
                grid, {0, 0}, {399, 399}, [&] { return ++asked == 2; }, &blocks),
            SearchOutcome::kInterrupted);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(a_star.expanded(), 0) << "told while the bounds were worked out";
}

/// A ring of blocked cells around the goal, one cell thick: blocks do not tell it.
SearchGrid ring_around(GridCell goal, std::int32_t side) {
  SearchGrid grid = empty_grid(side);
  std::vector<std::uint8_t> passable;
  visit_cells(grid, [&](GridCell c) {
    passable.push_back(std::max(std::abs(c.x - goal.x), std::abs(c.y - goal.y)) == 5 ? 0 : 1);
  });
  grid.edges = edges_of_passable(passable, side, side);
  return grid;
}

TEST(AStar, TellsEarlyThatTheGoalIsShutInAndWhatLiesOnItsSide) {
  const GridCell goal{200, 203};
  const SearchGrid grid = ring_around(goal, 400);
  const BlockWeights blocks = block_weights(grid);
  AStar a_star;
  for (const BlockWeights* const aid : {static_cast<const BlockWeights*>(nullptr), &blocks}) {
    ASSERT_EQ(a_star.search(grid, {3, 3}, goal, {}, aid, OnNoPath::kTellEarly), SearchOutcome::kNoPath);
    ASSERT_TRUE(a_star.told_early());
    EXPECT_LT(a_star.expanded(), 5000);
    visit_cells(grid, [&](GridCell c) {
      const bool inside = std::max(std::abs(c.x - goal.x), std::abs(c.y - goal.y)) < 5;
      EXPECT_EQ(a_star.on_goal_side(c), inside) << c.x << "," << c.y;
    });
    ASSERT_EQ(a_star.search(grid, {3, 3}, goal, {}, aid), SearchOutcome::kNoPath);
    EXPECT_FALSE(a_star.told_early());
    EXPECT_NE(a_star.cost_of({399, 0}), AStar::kUnreached);
    EXPECT_EQ(a_star.cost_of(goal), AStar::kUnreached);
  }
}

TEST(AStar, NeverPutsACellThatCanBeReachedOnTheGoalsSide) {
  AStar a_star;
  int told = 0;
  for (unsigned seed = 0; seed < 1500; ++seed) {
    const RandomGrid r = random_grid(seed, 12);
    const BlockWeights blocks = block_weights(r.grid);
    const SearchOutcome outcome = a_star.search(r.grid, r.start, r.goal, {}, &blocks, OnNoPath::kTellEarly);
    if (outcome != SearchOutcome::kNoPath || !a_star.told_early()) continue;
    ++told;
    const auto truth = dijkstra(r.grid, r.start);
    visit_cells(r.grid, [&](GridCell c) {
      if (truth[r.grid.index(c)] == UINT64_MAX) return;
      EXPECT_FALSE(a_star.on_goal_side(c)) << "seed " << seed;
    });
  }
  EXPECT_GT(told, 50);
}

}  // namespace
}  // namespace floornav
