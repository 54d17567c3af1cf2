#include "planner/search/jump_point_search.hpp"

#include <random>

#include <gtest/gtest.h>

#include "tests/planner/random_grid.hpp"

namespace floornav {
namespace {

struct RandomCells {
  std::int32_t width = 0, height = 0;
  std::vector<std::uint8_t> passable;
  GridCell start, goal;
};

/// Clutter of any density, or rooms: walls with doors.
RandomCells random_cells(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  RandomCells r;
  r.width = uniform(1, 150);
  r.height = uniform(1, 150);
  const auto at = [&](std::int32_t x, std::int32_t y) { return static_cast<std::size_t>(y * r.width + x); };
  const int blocked_percent = seed % 2 == 0 ? uniform(0, 45) : 0;
  for (std::int32_t i = 0; i < r.width * r.height; ++i)
    r.passable.push_back(uniform(0, 99) >= blocked_percent);
  for (int wall = seed % 2 == 0 ? 0 : 12; wall > 0; --wall) {
    const bool upright = uniform(0, 1) == 1;
    const std::int32_t line = uniform(0, (upright ? r.width : r.height) - 1);
    for (std::int32_t i = 0; i < (upright ? r.height : r.width); ++i)
      if (uniform(0, 19) != 0) r.passable[upright ? at(line, i) : at(i, line)] = 0;
  }
  r.start = {uniform(0, r.width - 1), uniform(0, r.height - 1)};
  r.goal = {uniform(0, r.width - 1), uniform(0, r.height - 1)};
  r.passable[at(r.start.x, r.start.y)] = r.passable[at(r.goal.x, r.goal.y)] = 1;
  return r;
}

BitGrid bits_of(const RandomCells& r) {
  BitGrid bits;
  bits.reset(r.width, r.height);
  for (std::int32_t y = 0; y < r.height; ++y)
    for (std::int32_t x = 0; x < r.width; ++x)
      bits.set({x, y}, r.passable[static_cast<std::size_t>(y * r.width + x)] != 0);
  return bits;
}

SearchGrid grid_of(const RandomCells& r) {
  SearchGrid grid;
  grid.width = r.width;
  grid.height = r.height;
  grid.edges = edges_of_passable(r.passable, r.width, r.height);
  grid.whole_squares = true;
  return grid;
}

TEST(JumpPointSearch, FindsPathsAsShortAsAStarDoes) {
  AStar a_star;
  JumpPointSearch search;
  std::vector<GridCell> path;
  int found = 0, absent = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    const RandomCells r = random_cells(seed);
    const SearchGrid grid = grid_of(r);
    const SearchOutcome truth = a_star.search(grid, r.start, r.goal);
    ASSERT_EQ(search.search(bits_of(r), r.start, r.goal), truth) << "seed " << seed;
    if (truth == SearchOutcome::kNoPath) {
      ++absent;
      continue;
    }
    ++found;
    search.path(path);
    ASSERT_EQ(path.front(), r.start);
    ASSERT_EQ(path.back(), r.goal);
    ASSERT_EQ(cost_along(grid, path), a_star.cost_of(r.goal)) << "seed " << seed;
  }
  EXPECT_GT(found, 200);
  EXPECT_GT(absent, 20);
}

TEST(JumpPointSearch, SeesCellsThatChangeBetweenSearches) {
  JumpPointSearch search;
  BitGrid bits;
  bits.reset(100, 3);
  for (std::int32_t y = 0; y < 3; ++y)
    for (std::int32_t x = 0; x < 100; ++x) bits.set({x, y}, true);
  EXPECT_EQ(search.search(bits, {0, 1}, {99, 1}), SearchOutcome::kFound);
  for (std::int32_t y = 0; y < 3; ++y) bits.set({64, y}, false);
  EXPECT_EQ(search.search(bits, {0, 1}, {99, 1}), SearchOutcome::kNoPath);
  bits.set({64, 2}, true);
  EXPECT_EQ(search.search(bits, {0, 1}, {99, 1}), SearchOutcome::kFound);
}

TEST(JumpPointSearch, StopsWhenInterrupted) {
  const RandomCells r = random_cells(10);
  RandomCells clutter = r;
  clutter.width = clutter.height = 300;
  clutter.passable.assign(90000, 1);
  std::mt19937 random(1);
  for (auto& p : clutter.passable) p = random() % 4 != 0;
  clutter.passable.front() = clutter.passable.back() = 1;
  for (const std::size_t wall : {89998U, 89699U, 89698U}) clutter.passable[wall] = 0;
  JumpPointSearch search;
  int asked = 0;
  EXPECT_EQ(search.search(bits_of(clutter), {0, 0}, {299, 299}, [&] { return ++asked == 3; }),
            SearchOutcome::kInterrupted);
  EXPECT_EQ(asked, 3);
  EXPECT_LE(search.expanded(), 1000) << "less than a millisecond's work";
  EXPECT_EQ(search.search(bits_of(clutter), {0, 0}, {299, 299}), SearchOutcome::kNoPath);
}

TEST(BitGridProjection, KeepsOnlyCellsBetweenWhichTheCornerRuleAloneShutsSteps) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const RandomCells r = random_cells(seed);
    SearchGrid grid = grid_of(r);
    std::mt19937 random(seed);
    for (int n = 0; n < r.width * r.height / 30; ++n) {  // close some edges both ways
      const GridCell cell{static_cast<std::int32_t>(random() % static_cast<unsigned>(r.width)),
                          static_cast<std::int32_t>(random() % static_cast<unsigned>(r.height))};
      const std::size_t k = random() % 8;
      const GridCell to{cell.x + kStepX[k], cell.y + kStepY[k]};
      if (!grid.contains(to)) continue;
      grid.edges[grid.index(cell)] &= static_cast<std::uint8_t>(~(1U << k));
      grid.edges[grid.index(to)] &= static_cast<std::uint8_t>(~(1U << (k + 4) % 8));
    }
    BitGrid bits;
    project(grid, bits);
    std::vector<std::uint8_t> kept;
    for (std::int32_t y = 0; y < r.height; ++y)
      for (std::int32_t x = 0; x < r.width; ++x) kept.push_back(bits.free({x, y}));
    const auto edges = edges_of_passable(kept, r.width, r.height);
    for (std::size_t i = 0; i < edges.size(); ++i)
      ASSERT_EQ(edges[i] & ~grid.edges[i], 0) << "seed " << seed << ": a step that the grid does not have";
  }
}

}  // namespace
}  // namespace floornav
