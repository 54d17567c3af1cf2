#include "planner/way_out.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <tuple>

#include "planner/search/octile.hpp"

namespace floornav {
namespace {

constexpr StepCosts kSteps = kWeightedSteps;

/// Dijkstra's search over the few cells around a robot that is too near to something.
class Escape {
 public:
  explicit Escape(const PlanningGrid& grid) : grid_(grid) {}

  std::optional<std::vector<GridCell>> find(GridCell from, std::uint32_t most) {
    reach(from, 0, from);
    while (!open_.empty()) {
      const auto [cost, item] = open_.top();
      open_.pop();
      const GridCell cell = unpack(item);
      if (cost > known_.at(item).cost) continue;
      if (grid_.passable(cell) && grid_.roomy(cell)) return way_to(cell);
      for (std::size_t k = 0; k < 8; ++k) {
        const std::uint32_t next = cost + (k % 2 == 1 ? kSteps.diagonal : kSteps.straight);
        if (next <= most && may_step(cell, k)) reach({cell.x + kStepX[k], cell.y + kStepY[k]}, next, cell);
      }
    }
    return std::nullopt;
  }

 private:
  struct Known {
    std::uint32_t cost;
    GridCell from;
  };

  [[nodiscard]] bool has_floor(GridCell c) const {
    return grid_.floor(c) == Floor::kFree || grid_.floor(c) == Floor::kAssumed;
  }
  /// Of a diagonal step both cells that it passes between count too.
  [[nodiscard]] bool may_step(GridCell from, std::size_t k) const {
    const auto open = [&](std::size_t by) {
      const GridCell to{from.x + kStepX[by], from.y + kStepY[by]};
      return grid_.map_edge_open(from, by) && has_floor(to) &&
             grid_.obstacle_clearance_m(to) >= grid_.obstacle_clearance_m(from);
    };
    return k % 2 == 0 ? open(k) : open(k) && open(k - 1) && open((k + 1) % 8);
  }
  void reach(GridCell cell, std::uint32_t cost, GridCell from) {
    const auto [it, is_new] = known_.try_emplace(pack(cell), Known{cost, from});
    if (!is_new && it->second.cost <= cost) return;
    it->second = {cost, from};
    open_.emplace(cost, pack(cell));
  }
  [[nodiscard]] std::vector<GridCell> way_to(GridCell cell) const {
    std::vector<GridCell> way{cell};
    while (known_.at(pack(cell)).cost > 0) way.push_back(cell = known_.at(pack(cell)).from);
    std::reverse(way.begin(), way.end());
    return way;
  }

  using Waiting = std::tuple<std::uint32_t, std::uint32_t>;
  const PlanningGrid& grid_;
  std::map<std::uint32_t, Known> known_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> open_;
};

}  // namespace

std::optional<std::vector<GridCell>> way_out(const PlanningGrid& grid, GridCell from, double reach_m) {
  if (!grid.search_grid().contains(from) || grid.floor(from) == Floor::kBlocked) return std::nullopt;
  return Escape(grid).find(from, static_cast<std::uint32_t>(reach_m / grid.pitch_m() * kSteps.straight));
}

}  // namespace floornav
