#include "tools/bench/d_star_lite.hpp"

#include <random>

#include <gtest/gtest.h>

#include "planner/search/a_star.hpp"

namespace floornav {
namespace {

class DStarLiteOfSeed : public testing::TestWithParam<unsigned> {};

TEST_P(DStarLiteOfSeed, CostsWhatAStarDoesAfterHundredsOfEdits) {
  std::mt19937 random(GetParam());
  const auto below = [&](std::int32_t n) {
    return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
  };
  constexpr std::int32_t kSide = 48;
  std::vector<std::uint8_t> passable(kSide * kSide, 1);
  SearchGrid grid;
  grid.width = grid.height = kSide;
  grid.whole_squares = true;
  grid.edges = edges_of_passable(passable, kSide, kSide);
  if (GetParam() % 2 == 0) {
    grid.steps = kWeightedSteps;
    for (auto& p : passable) grid.weights.push_back(static_cast<std::uint8_t>(p * below(120)));
  }
  GridCell start{2, 2};
  const GridCell goal{45, 40};
  DStarLite incremental;
  incremental.begin(grid, start, goal);
  AStar a_star;
  int found = 0;
  for (int edit = 0; edit < 300; ++edit) {
    const CellRect rect = CellRect{below(kSide), below(kSide), 0, 0};
    const CellRect changed{rect.x0, rect.y0, std::min(rect.x0 + 1 + below(6), kSide),
                           std::min(rect.y0 + 1 + below(6), kSide)};
    const bool free = below(100) < 40;
    for (std::int32_t y = changed.y0; y < changed.y1; ++y)
      for (std::int32_t x = changed.x0; x < changed.x1; ++x) {
        passable[grid.index({x, y})] = free || below(3) == 0;
        if (!grid.weights.empty()) grid.weights[grid.index({x, y})] = static_cast<std::uint8_t>(below(200));
      }
    grid.edges = edges_of_passable(passable, kSide, kSide);
    start = {std::min(start.x + below(2), kSide - 1), std::min(start.y + below(2), 30)};
    incremental.repair(start, changed.grown(1));
    const SearchOutcome truth = a_star.search(grid, start, goal);
    ASSERT_EQ(incremental.cost(),
              truth == SearchOutcome::kFound ? a_star.cost_of(goal) : DStarLite::kUnreached)
        << "edit " << edit;
    found += truth == SearchOutcome::kFound;
  }
  EXPECT_GT(found, 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DStarLiteOfSeed, testing::Range(0U, 10U));

}  // namespace
}  // namespace floornav
