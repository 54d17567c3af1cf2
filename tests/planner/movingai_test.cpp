#include "tools/bench/movingai.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "planner/search/a_star.hpp"
#include "planner/search/bit_grid.hpp"
#include "planner/search/jump_point_search.hpp"

namespace floornav {
namespace {

namespace fs = std::filesystem;

fs::path movingai_folder() {
  const char* const data = std::getenv("FLOORNAV_DATA");
  const fs::path root = data != nullptr ? fs::path(data) : fs::path(FLOORNAV_SOURCE_DIR) / "../shared/data";
  return root / "movingai";
}

/// A few maps of different kinds; all of them where FLOORNAV_LONG is set in the environment.
std::set<std::string> maps_to_try() {
  if (std::getenv("FLOORNAV_LONG") == nullptr)
    return {"arena", "den312d", "ost003d", "Berlin_0_256", "AR0011SR"};
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(movingai_folder()))
    if (entry.path().extension() == ".map") names.insert(entry.path().stem().string());
  return names;
}

/// Published lengths of eight decimals are sums of rounded steps. Different lengths of paths under 5741
/// diagonal steps lie further apart than 5e-5.
constexpr double kPublishedRounding = 1e-5;

void expect_published_length(const std::string& map, const MovingAiProblem& p,
                             const std::vector<GridCell>& path) {
  ASSERT_NEAR(path_length(path), p.optimal, std::max(0.51 * p.last_digit, kPublishedRounding))
      << map << " " << p.start.x << "," << p.start.y << " to " << p.goal.x << "," << p.goal.y;
}

TEST(MovingAi, EveryProblemHasThePublishedLengthByBothSearches) {
  if (!fs::exists(movingai_folder())) GTEST_SKIP() << "no benchmark maps at " << movingai_folder();
  AStar a_star;
  JumpPointSearch jump_point_search;
  BitGrid bits;
  std::vector<GridCell> path;
  std::size_t solved = 0;
  for (const std::string& name : maps_to_try()) {
    const SearchGrid grid = read_movingai_map(movingai_folder() / (name + ".map"));
    project(grid, bits);
    for (const MovingAiProblem& p : read_movingai_problems(movingai_folder() / (name + ".map.scen"))) {
      ASSERT_EQ(a_star.search(grid, p.start, p.goal), SearchOutcome::kFound) << name;
      a_star.path_to(p.goal, path);
      expect_published_length(name, p, path);
      if (p.start == p.goal) continue;
      ASSERT_EQ(jump_point_search.search(bits, p.start, p.goal), SearchOutcome::kFound) << name;
      jump_point_search.path(path);
      expect_published_length(name, p, path);
      ++solved;
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(solved, 3000U);
}

}  // namespace
}  // namespace floornav
