#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "planner/search/search_grid.hpp"

namespace floornav {

struct RandomGrid {
  SearchGrid grid;
  GridCell start, goal;
};

/// Closes every diagonal of a square that has a closed side.
inline void close_diagonals_of_broken_squares(SearchGrid& grid) {
  const auto open = [&](std::int32_t x, std::int32_t y, unsigned k) {
    return (grid.edges[grid.index({x, y})] >> k & 1) != 0;
  };
  for (std::int32_t y = 0; y + 1 < grid.height; ++y)
    for (std::int32_t x = 0; x + 1 < grid.width; ++x) {
      if (open(x, y, 0) && open(x, y, 2) && open(x + 1, y, 2) && open(x, y + 1, 0)) continue;
      grid.edges[grid.index({x, y})] &= static_cast<std::uint8_t>(~(1U << 1));
      grid.edges[grid.index({x + 1, y + 1})] &= static_cast<std::uint8_t>(~(1U << 5));
      grid.edges[grid.index({x + 1, y})] &= static_cast<std::uint8_t>(~(1U << 3));
      grid.edges[grid.index({x, y + 1})] &= static_cast<std::uint8_t>(~(1U << 7));
    }
}

/// Weighted cells, some blocked, and single edges closed both ways at random. Weights of every kind: few
/// heavy cells, any, fields of one weight, slopes. Blocked are patches of cells, `patch` along a side.
inline RandomGrid random_grid(unsigned seed, int patch = 1) {
  std::mt19937 random(seed);
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  RandomGrid r;
  r.grid.width = uniform(1, 40);
  r.grid.height = uniform(1, 40);
  const bool weighted = uniform(0, 2) != 0;
  r.grid.steps = weighted ? kWeightedSteps : kExactSteps;
  const auto cells = static_cast<std::size_t>(r.grid.width * r.grid.height);
  const int blocked_percent = uniform(0, 45);
  std::vector<std::uint8_t> passable(cells);
  for (auto& p : passable) p = uniform(0, 99) >= blocked_percent;
  for (int i = 0; i < static_cast<int>(cells); ++i) {
    const int x = i % r.grid.width, y = i / r.grid.width;
    passable[static_cast<std::size_t>(i)] =
        passable[static_cast<std::size_t>((y - y % patch) * r.grid.width + x - x % patch)];
  }
  r.grid.edges = edges_of_passable(passable, r.grid.width, r.grid.height);
  const int closed_percent = uniform(0, 30);
  for (std::int32_t y = 0; y < r.grid.height; ++y)
    for (std::int32_t x = 0; x < r.grid.width; ++x)
      for (unsigned k = 0; k < 4; ++k) {
        const GridCell to{x + kStepX[k], y + kStepY[k]};
        if (uniform(0, 99) >= closed_percent || !r.grid.contains(to)) continue;
        r.grid.edges[r.grid.index({x, y})] &= static_cast<std::uint8_t>(~(1U << k));
        r.grid.edges[r.grid.index(to)] &= static_cast<std::uint8_t>(~(1U << (k + 4)));
      }
  r.grid.whole_squares = uniform(0, 3) != 0;
  if (r.grid.whole_squares) close_diagonals_of_broken_squares(r.grid);
  if (weighted) {
    const int kind = uniform(0, 3), heaviest = uniform(1, 255);
    for (std::size_t i = 0; i < cells; ++i) {
      const auto x = static_cast<int>(i) % r.grid.width, y = static_cast<int>(i) / r.grid.width;
      const int weight = kind == 0   ? (uniform(0, 3) == 0 ? uniform(0, heaviest) : 0)
                         : kind == 1 ? uniform(0, heaviest)
                         : kind == 2 ? (x / 8 + y / 8) % 3 * (heaviest / 3)
                                     : (x * 7 + y * 3) % (heaviest + 1);
      r.grid.weights.push_back(static_cast<std::uint8_t>(weight));
    }
  }
  r.start = {uniform(0, r.grid.width - 1), uniform(0, r.grid.height - 1)};
  r.goal = {uniform(0, r.grid.width - 1), uniform(0, r.grid.height - 1)};
  return r;
}

inline std::uint64_t step_cost(const SearchGrid& grid, GridCell from, std::size_t k) {
  const GridCell to{from.x + kStepX[k], from.y + kStepY[k]};
  const std::uint64_t base = k % 2 == 1 ? grid.steps.diagonal : grid.steps.straight;
  const std::uint64_t sum =
      grid.weights.empty() ? 0U
                           : std::uint64_t{grid.weights[grid.index(from)]} + grid.weights[grid.index(to)];
  return base * (64 + sum) / 64;
}

/// Least costs from the start to every cell, by the plain textbook method on a binary heap.
inline std::vector<std::uint64_t> dijkstra(const SearchGrid& grid, GridCell start) {
  std::vector<std::uint64_t> cost(grid.edges.size(), UINT64_MAX);
  using Item = std::tuple<std::uint64_t, std::int32_t, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  cost[grid.index(start)] = 0;
  queue.emplace(0, start.x, start.y);
  while (!queue.empty()) {
    const auto [c, x, y] = queue.top();
    queue.pop();
    if (c != cost[grid.index({x, y})]) continue;
    for (std::size_t k = 0; k < 8; ++k) {
      if ((grid.edges[grid.index({x, y})] >> k & 1) == 0) continue;
      const GridCell to{x + kStepX[k], y + kStepY[k]};
      const std::uint64_t through = c + step_cost(grid, {x, y}, k);
      if (through >= cost[grid.index(to)]) continue;
      cost[grid.index(to)] = through;
      queue.emplace(through, to.x, to.y);
    }
  }
  return cost;
}

/// Cost of a path step by step over open edges; fails the test where it leaves them.
inline std::uint64_t cost_along(const SearchGrid& grid, const std::vector<GridCell>& path) {
  std::uint64_t cost = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    std::size_t k = 0;
    while (k < 8 && (path[i - 1].x + kStepX[k] != path[i].x || path[i - 1].y + kStepY[k] != path[i].y)) ++k;
    if (k == 8 || (grid.edges[grid.index(path[i - 1])] >> k & 1) == 0) {
      ADD_FAILURE() << "step " << i << " is no open edge";
      return 0;
    }
    cost += step_cost(grid, path[i - 1], k);
  }
  return cost;
}

inline SearchGrid empty_grid(std::int32_t side) {
  SearchGrid grid;
  grid.width = grid.height = side;
  const auto cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  grid.edges = edges_of_passable(std::vector<std::uint8_t>(cells, 1), side, side);
  grid.weights.assign(cells, 0);
  grid.steps = kWeightedSteps;
  grid.whole_squares = true;
  return grid;
}

}  // namespace floornav
