#include "planner/search/a_star.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "planner/search/octile.hpp"

namespace floornav {
namespace {

constexpr std::uint32_t kMaxSearches = (1U << 28) - 1;

}  // namespace

void AStar::prepare(const SearchGrid& grid) {
  if (grid.width > SearchGrid::kMaxSide || grid.height > SearchGrid::kMaxSide)
    throw std::invalid_argument("a search grid has at most 65535 cells along a side");
  const std::size_t cells = grid.edges.size();
  if (cells > nodes_.size() || number_ == kMaxSearches) {
    nodes_.assign(std::max(cells, nodes_.size()), Node{});
    number_ = 0;
  }
  ++number_;
  width_ = grid.width;
  expanded_ = 0;
  const std::uint32_t heaviest = grid.weights.empty() ? 0 : 255;
  // A step raises cost + heuristic by at most its own cost and one diagonal step more.
  queue_.reset(SearchGrid::weighted(grid.steps.diagonal, heaviest, heaviest) + grid.steps.diagonal + 1);
}

SearchOutcome AStar::search(const SearchGrid& grid, GridCell start, GridCell goal,
                            const Interrupt& interrupt) {
  if (!grid.contains(start) || !grid.contains(goal))
    throw std::invalid_argument("start or goal off the search grid");
  prepare(grid);
  start_ = start;
  return grid.weights.empty() ? run<false>(grid, start, goal, interrupt)
                              : run<true>(grid, start, goal, interrupt);
}

template <bool kWeighted>
SearchOutcome AStar::run(const SearchGrid& grid, GridCell start, GridCell goal, const Interrupt& interrupt) {
  const StepCosts steps = grid.steps;
  const std::uint8_t* const edges = grid.edges.data();
  const std::uint8_t* const weights = grid.weights.data();
  Node* const nodes = nodes_.data();
  const std::uint32_t number = number_;
  const std::uint32_t goal_item = pack(goal);
  // Beyond this a sum of costs could overflow: such cells are not expanded.
  const std::uint32_t max_cost = kUnreached - 32 * steps.diagonal - octile(grid.width, grid.height, steps);
  std::array<std::int32_t, 8> offsets;
  for (std::size_t k = 0; k < 8; ++k) offsets[k] = kStepY[k] * grid.width + kStepX[k];

  nodes[grid.index(start)] = {0, number & kMaxSearches, 0, 0};
  queue_.push(octile(goal.x - start.x, goal.y - start.y, steps), pack(start));
  std::uint32_t item = 0;
  while (queue_.pop(item)) {
    const GridCell cell = unpack(item);
    const std::size_t index = grid.index(cell);
    Node& node = nodes[index];
    if (node.settled != 0) continue;
    node.settled = 1;
    if (item == goal_item) return SearchOutcome::kFound;
    if ((++expanded_ & (kExpansionsBetweenInterrupts - 1)) == 0 && interrupt && interrupt())
      return SearchOutcome::kInterrupted;
    if (node.cost > max_cost) continue;
    for (unsigned open = edges[index]; open != 0; open &= open - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(open));
      const std::size_t next = index + static_cast<std::size_t>(static_cast<std::ptrdiff_t>(offsets[k]));
      const std::uint32_t base = (k & 1) != 0 ? steps.diagonal : steps.straight;
      const std::uint32_t cost =
          node.cost + (kWeighted ? SearchGrid::weighted(base, weights[index], weights[next]) : base);
      Node& neighbour = nodes[next];
      if (neighbour.search == number && neighbour.cost <= cost) continue;
      neighbour = {cost, number & kMaxSearches, 0, static_cast<std::uint32_t>(k) & 7U};
      const GridCell to{cell.x + kStepX[k], cell.y + kStepY[k]};
      queue_.push(cost + octile(goal.x - to.x, goal.y - to.y, steps), pack(to));
    }
  }
  return SearchOutcome::kNoPath;
}

std::uint32_t AStar::cost_of(GridCell cell) const {
  const Node& node = nodes_[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
                            static_cast<std::size_t>(cell.x)];
  return node.search == number_ && node.settled != 0 ? node.cost : kUnreached;
}

void AStar::path_to(GridCell cell, std::vector<GridCell>& path) const {
  path.clear();
  while (cell != start_) {
    path.push_back(cell);
    const Node& node = nodes_[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(cell.x)];
    cell = {cell.x - kStepX[node.from], cell.y - kStepY[node.from]};
  }
  path.push_back(start_);
  std::reverse(path.begin(), path.end());
}

}  // namespace floornav
