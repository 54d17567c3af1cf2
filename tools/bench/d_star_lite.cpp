#include "tools/bench/d_star_lite.hpp"

#include <algorithm>
#include <bit>
#include <functional>

#include "planner/search/octile.hpp"

namespace floornav {
namespace {

std::uint32_t plus(std::uint32_t cost, std::uint32_t step) {
  return cost == DStarLite::kUnreached ? cost : cost + step;
}

GridCell neighbour(GridCell c, std::size_t k) {
  return {c.x + kStepX[k], c.y + kStepY[k]};
}

template <class Visit>
void visit_open(const SearchGrid& grid, GridCell cell, const Visit& visit) {
  for (unsigned open = grid.edges[grid.index(cell)]; open != 0; open &= open - 1)
    visit(static_cast<std::size_t>(std::countr_zero(open)));
}

}  // namespace

void DStarLite::begin(const SearchGrid& grid, GridCell start, GridCell goal) {
  grid_ = &grid;
  edges_ = grid.edges;
  weights_ = grid.weights;
  nodes_.assign(grid.edges.size(), Node{});
  queue_.clear();
  start_ = start;
  goal_ = goal;
  moved_ = 0;
  nodes_[grid.index(goal)].rhs = 0;
  wait_if_uneven(goal);
  search();
}

void DStarLite::repair(GridCell start, const CellRect& changed) {
  moved_ += octile(start.x - start_.x, start.y - start_.y, grid_->steps);
  start_ = start;
  const CellRect rect = changed.clipped({0, 0, grid_->width, grid_->height});
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const std::size_t i = grid_->index({x, y});
      const bool same =
          edges_[i] == grid_->edges[i] && (weights_.empty() || weights_[i] == grid_->weights[i]);
      if (same) continue;
      edges_[i] = grid_->edges[i];
      if (!weights_.empty()) weights_[i] = grid_->weights[i];
      look_ahead({x, y});
      for (std::size_t k = 0; k < 8; ++k)
        if (const GridCell to = neighbour({x, y}, k); grid_->contains(to)) look_ahead(to);
    }
  }
  search();
}

std::uint64_t DStarLite::key_of(GridCell cell) const {
  const Node& node = nodes_[grid_->index(cell)];
  const std::uint64_t least = std::min(node.g, node.rhs);
  const std::uint64_t first = least + octile(cell.x - start_.x, cell.y - start_.y, grid_->steps) + moved_;
  return std::min<std::uint64_t>(first, kUnreached) << 32 | least;
}

std::uint32_t DStarLite::step(std::size_t from, std::size_t to, std::size_t k) const {
  const std::uint32_t base = k % 2 == 1 ? grid_->steps.diagonal : grid_->steps.straight;
  return grid_->weights.empty() ? base : SearchGrid::weighted(base, grid_->weights[from], grid_->weights[to]);
}

/// The cost of a cell by what its neighbours cost now.
void DStarLite::look_ahead(GridCell cell) {
  const std::size_t i = grid_->index(cell);
  if (cell != goal_) {
    std::uint32_t least = kUnreached;
    visit_open(*grid_, cell, [&](std::size_t k) {
      const std::size_t to = grid_->index(neighbour(cell, k));
      least = std::min(least, plus(nodes_[to].g, step(i, to, k)));
    });
    nodes_[i].rhs = least;
  }
  wait_if_uneven(cell);
}

/// Keys that the queue holds may be out of date: they are looked at again when their turn comes.
void DStarLite::wait_if_uneven(GridCell cell) {
  const Node& node = nodes_[grid_->index(cell)];
  if (node.g == node.rhs) return;
  queue_.push_back({key_of(cell), pack(cell)});
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void DStarLite::search() {
  while (!queue_.empty()) {
    const Node& start = nodes_[grid_->index(start_)];
    const Waiting top = queue_.front();
    if (top.key >= key_of(start_) && start.rhs == start.g) break;
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    const GridCell cell = unpack(top.item);
    const Node& node = nodes_[grid_->index(cell)];
    if (node.g == node.rhs) continue;
    if (top.key < key_of(cell))
      wait_if_uneven(cell);
    else
      settle(cell);
  }
}

void DStarLite::settle(GridCell cell) {
  const std::size_t i = grid_->index(cell);
  Node& node = nodes_[i];
  if (node.g > node.rhs) {
    node.g = node.rhs;
    visit_open(*grid_, cell, [&](std::size_t k) {
      const GridCell from = neighbour(cell, k);
      const std::size_t at = grid_->index(from);
      const std::uint32_t through = node.g + step(i, at, k);
      if (through >= nodes_[at].rhs) return;
      nodes_[at].rhs = through;
      wait_if_uneven(from);
    });
    return;
  }
  const std::uint32_t before = node.g;
  node.g = kUnreached;
  visit_open(*grid_, cell, [&](std::size_t k) {
    const GridCell from = neighbour(cell, k);
    const std::size_t at = grid_->index(from);
    if (nodes_[at].rhs == plus(before, step(i, at, k))) look_ahead(from);
  });
  wait_if_uneven(cell);
}

}  // namespace floornav
