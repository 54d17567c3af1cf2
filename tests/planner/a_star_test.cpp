#include "planner/search/a_star.hpp"

#include <gtest/gtest.h>

#include "tests/planner/random_grid.hpp"

namespace floornav {
namespace {

TEST(AStar, EqualsDijkstraOnRandomWeightedGridsWithClosedEdges) {
  AStar a_star;  // one for all, so that numbers of searches instead of clearing are tried too
  std::vector<GridCell> path;
  int found = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    const RandomGrid r = random_grid(seed);
    const std::uint64_t truth = dijkstra(r.grid, r.start)[r.grid.index(r.goal)];
    const BlockWeights blocks = block_weights(r.grid);
    for (const BlockWeights* const aid : {static_cast<const BlockWeights*>(nullptr), &blocks}) {
      const SearchOutcome outcome = a_star.search(r.grid, r.start, r.goal, {}, aid, OnNoPath::kTellEarly);
      ASSERT_EQ(outcome, truth == UINT64_MAX ? SearchOutcome::kNoPath : SearchOutcome::kFound)
          << "seed " << seed;
      if (outcome == SearchOutcome::kNoPath) continue;
      ++found;
      a_star.path_to(r.goal, path);
      ASSERT_EQ(path.front(), r.start);
      ASSERT_EQ(path.back(), r.goal);
      ASSERT_EQ(a_star.cost_of(r.goal), truth) << "seed " << seed;
      ASSERT_EQ(cost_along(r.grid, path), truth) << "seed " << seed;
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(AStar, SettlesEveryReachableCellWhereThereIsNoPath) {
  AStar a_star;
  int failures = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const RandomGrid r = random_grid(seed);
    if (a_star.search(r.grid, r.start, r.goal) != SearchOutcome::kNoPath) continue;
    ++failures;
    const auto truth = dijkstra(r.grid, r.start);
    for (std::int32_t y = 0; y < r.grid.height; ++y)
      for (std::int32_t x = 0; x < r.grid.width; ++x) {
        const std::uint64_t expected = truth[r.grid.index({x, y})];
        ASSERT_EQ(a_star.cost_of({x, y}), expected == UINT64_MAX ? AStar::kUnreached : expected)
            << "seed " << seed;
      }
  }
  EXPECT_GT(failures, 50);
}

TEST(AStar, ExpandsOnlyTheStraightLineOnAnEmptyGrid) {
  const SearchGrid grid = empty_grid(500);
  AStar a_star;
  ASSERT_EQ(a_star.search(grid, {3, 250}, {496, 250}), SearchOutcome::kFound);
  EXPECT_EQ(a_star.cost_of({496, 250}), 493U * 408U);
  EXPECT_LT(a_star.expanded(), 600);
}

TEST(AStar, AsksForAnInterruptAndStops) {
  SearchGrid grid = empty_grid(300);
  grid.edges[grid.index({299, 299})] = 0;
  for (const GridCell wall : {GridCell{298, 299}, {299, 298}, {298, 298}}) grid.edges[grid.index(wall)] = 0;
  AStar a_star;
  int asked = 0;
  EXPECT_EQ(a_star.search(grid, {0, 0}, {299, 299}, [&] { return ++asked == 5; }),
            SearchOutcome::kInterrupted);
  EXPECT_EQ(a_star.expanded(), 5 * AStar::kExpansionsBetweenInterrupts);
  EXPECT_EQ(a_star.search(grid, {0, 0}, {299, 299}), SearchOutcome::kNoPath);
}

TEST(AStar, FindsTheSamePathWhateverWasSearchedBefore) {
  AStar used;
  std::vector<GridCell> path, again;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const RandomGrid r = random_grid(seed);
    AStar fresh;
    if (fresh.search(r.grid, r.start, r.goal) != SearchOutcome::kFound) continue;
    ASSERT_EQ(used.search(r.grid, r.start, r.goal), SearchOutcome::kFound);
    fresh.path_to(r.goal, path);
    used.path_to(r.goal, again);
    EXPECT_EQ(path, again) << "seed " << seed;
  }
}

TEST(AStar, RefusesCellsOffTheGrid) {
  const SearchGrid grid = empty_grid(3);
  AStar a_star;
  EXPECT_THROW(a_star.search(grid, {0, 0}, {3, 0}), std::invalid_argument);
  EXPECT_THROW(a_star.search(grid, {-1, 0}, {0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace floornav
