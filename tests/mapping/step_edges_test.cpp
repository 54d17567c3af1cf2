#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

class RandomFields : public testing::TestWithParam<unsigned> {};

// Brute force over the whole map: which steps are open by eq. (2), which vertices the robot reaches, which
// edges follow.
TEST_P(RandomFields, EdgesAreThoseOfEquation2) {
  std::mt19937 random(GetParam());
  constexpr int kSide = 70;
  std::vector<double> heights(kSide * kSide);
  for (double& z_m : heights) z_m = 0.005 * static_cast<int>(random() % 10);
  const auto height = [&](int ix, int iy) { return heights[static_cast<std::size_t>(iy * kSide + ix)]; };
  const Scene scene = [&](double x_m, double y_m) {
    return Ground{height(static_cast<int>(x_m / 0.05), static_cast<int>(y_m / 0.05))};
  };
  RobotSettings robot;
  robot.max_step_m = 0.0225;  // between the heights that occur, so that rounding decides nothing
  const WorldMap map = mapped({see(scene, {0, kSide * 0.05, 0, kSide * 0.05})}, {}, robot);
  const auto free = [&](int ix, int iy) { return map.grid().state({ix, iy}) == VertexState::kFree; };
  const auto side_open = [&](int ix, int iy, int dx, int dy) {
    return free(ix, iy) && free(ix + dx, iy + dy) &&
           std::abs(height(ix, iy) - height(ix + dx, iy + dy)) <= robot.max_step_m;
  };
  int open = 0;
  for (int iy = 1; iy < kSide - 1; ++iy) {
    for (int ix = 1; ix < kSide - 1; ++ix) {
      for (std::size_t k = 0; k < 8; ++k) {
        const int dx = kNeighbourX[k];
        const int dy = kNeighbourY[k];
        bool expected = side_open(ix, iy, dx, dy);
        if (dx != 0 && dy != 0)
          expected = expected && side_open(ix, iy, dx, 0) && side_open(ix, iy, 0, dy) &&
                     side_open(ix + dx, iy, 0, dy) && side_open(ix, iy + dy, dx, 0);
        EXPECT_EQ(edge_open(map, {ix, iy}, k), expected) << ix << " " << iy << " " << k;
        EXPECT_EQ(edge_open(map, {ix, iy}, k), edge_open(map, {ix + dx, iy + dy}, (k + 4) % 8));
        open += expected;
      }
    }
  }
  EXPECT_GT(open, 1000);
}

TEST_P(RandomFields, ReachableVerticesAreFreeAndIslandsBesideThemAreNot) {
  std::mt19937 random(GetParam());
  constexpr int kSide = 60;
  std::vector<double> heights(kSide * kSide, 0.0);
  std::vector<int> blocks(kSide * kSide, 0);
  for (int block = 0; block < 25; ++block) {  // plateaus that stand apart, each of one height above T
    const int ix = 2 + static_cast<int>(random() % 50);
    const int iy = 2 + static_cast<int>(random() % 50);
    const double z_m = 0.03 + 0.05 * static_cast<int>(random() % 5);
    for (int y = iy; y < iy + 5; ++y)
      for (int x = ix; x < ix + 5; ++x) heights[static_cast<std::size_t>(y * kSide + x)] = z_m;
  }
  const Scene scene = [&](double x_m, double y_m) {
    return Ground{heights[static_cast<std::size_t>(static_cast<int>(y_m / 0.05) * kSide +
                                                   static_cast<int>(x_m / 0.05))]};
  };
  const WorldMap map = mapped({see(scene, {0, kSide * 0.05, 0, kSide * 0.05})});
  std::vector<char> reached(kSide * kSide, 0);
  std::vector<int> queue{0};
  reached[0] = 1;
  while (!queue.empty()) {
    const int from = queue.back();
    queue.pop_back();
    for (std::size_t k = 0; k < 8; k += 2) {
      const int x = from % kSide + kNeighbourX[k];
      const int y = from / kSide + kNeighbourY[k];
      if (x < 0 || y < 0 || x >= kSide || y >= kSide) continue;
      const int to = y * kSide + x;
      const auto z_m = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
      if (reached[static_cast<std::size_t>(to)] || std::abs(z_m(to) - z_m(from)) > 0.02) continue;
      reached[static_cast<std::size_t>(to)] = 1;
      queue.push_back(to);
    }
  }
  for (int i = 0; i < kSide * kSide; ++i) {
    const bool floor = reached[static_cast<std::size_t>(i)];
    if (!floor && heights[static_cast<std::size_t>(i)] == 0.0)
      continue;  // a pit between plateaus: level, not joined
    EXPECT_EQ(map.grid().state({i % kSide, i / kSide}), floor ? VertexState::kFree : VertexState::kBlocked)
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFields, testing::Range(1U, 9U));

}  // namespace
}  // namespace floornav
