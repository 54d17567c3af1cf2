// Where on a planning grid the robot fits, what that costs and where it may step.

#include <algorithm>

#include "planner/planning_grid.hpp"

namespace floornav {

/// Marks free cells that a closed edge parts from another free one. Edges to what is not free are closed too,
/// but need no mark of their own.
void PlanningGrid::find_steps(const CellRect& rect) {
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const std::size_t i = search_.index({x, y});
      bool at_step = false;
      for (std::size_t k = 0; k < 8 && floor({x, y}) == Floor::kFree; k += 2) {
        const GridCell to{x + kStepX[k], y + kStepY[k]};
        at_step = at_step || (search_.contains(to) && !map_edge_open(i, search_.index(to), k));
      }
      kinds_[i] = static_cast<std::uint8_t>(at_step ? kinds_[i] | kAtStep : kinds_[i] & ~kAtStep);
    }
  }
}

/// Marks the cells within the least gap of those of a kind, after a change.
void PlanningGrid::find_near(std::uint8_t what, std::uint8_t mark, std::int16_t least_gap, GapScan& scan,
                             const CellRect& changed) {
  const CellRect out = changed.grown(scan.reach()).clipped({0, 0, search_.width, search_.height});
  scan.scan(cells_of(what), out, [&](std::int32_t y, const std::int16_t* gaps) {
    std::uint8_t* const kinds = kinds_.data() + search_.index({out.x0, y});
    for (std::int32_t i = 0; i < out.width(); ++i)
      kinds[i] = static_cast<std::uint8_t>(gaps[i] < least_gap ? kinds[i] | mark : kinds[i] & ~mark);
  });
}

void PlanningGrid::weigh(const CellRect& rect) {
  const std::uint8_t unknown = weight_of(settings_.unknown_cost);
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const std::size_t i = search_.index({x, y});
      const bool fits = blocked_gap_[i] >= least_gap_ && (kinds_[i] & kNearStep) == 0;
      kinds_[i] = static_cast<std::uint8_t>(fits ? kinds_[i] | kFits : kinds_[i] & ~kFits);
      if (search_.weights.empty()) continue;
      const unsigned unseen = (kinds_[i] & kNearUnknown) != 0 ? unknown : 0U;
      const unsigned near_obstacle = gap_weights_[static_cast<std::size_t>(blocked_gap_[i])];
      search_.weights[i] = static_cast<std::uint8_t>(std::min(255U, terrain_[i] + unseen + near_obstacle));
    }
  }
}

void PlanningGrid::open_edges(const CellRect& rect) {
  for (std::int32_t y = rect.y0; y < rect.y1; ++y)
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) search_.edges[search_.index({x, y})] = edges_at(x, y);
}

void PlanningGrid::project_open_cells(const CellRect& rect) {
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      std::uint8_t& kind = kinds_[search_.index({x, y})];
      const bool parted = search_.edges[search_.index({x, y})] != 0 && !in_the_open(search_, {x, y});
      parted_cells_ += (parted ? 1 : 0) - ((kind & kParted) != 0 ? 1 : 0);
      kind = static_cast<std::uint8_t>(parted ? kind | kParted : kind & ~kParted);
    }
  }
  const auto is_open = [&](GridCell cell) {
    return search_.edges[search_.index(cell)] != 0 && (kinds_[search_.index(cell)] & kParted) == 0;
  };
  if (rect.contains({0, 0, search_.width, search_.height}))
    return open_cells_.build(search_.width, search_.height, is_open);
  for (std::int32_t y = rect.y0; y < rect.y1; ++y)
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) open_cells_.set({x, y}, is_open({x, y}));
}

/// The map knows edges only between cells that were seen to be free.
bool PlanningGrid::map_edge_open(std::size_t from, std::size_t to, std::size_t k) const {
  constexpr unsigned kNotFree = kBlocked | kUnknown | kAssumed;
  if (((kinds_[from] | kinds_[to]) & kNotFree) != 0) return true;
  return (map_edges_[from] >> k & 1) != 0 && (map_edges_[to] >> ((k + 4) % 8) & 1) != 0;
}

bool PlanningGrid::map_edge_open(GridCell cell, std::size_t k) const {
  const GridCell to{cell.x + kStepX[k], cell.y + kStepY[k]};
  return search_.contains(cell) && search_.contains(to) &&
         map_edge_open(search_.index(cell), search_.index(to), k);
}

/// Steps out of a cell, to others that the robot fits in too. A diagonal one is open where all four edges of
/// the square that it crosses are: it cuts no corner, neither of an obstacle nor of a step.
std::uint8_t PlanningGrid::edges_at(std::int32_t x, std::int32_t y) const {
  if (!passable({x, y})) return 0;
  const auto link_open = [&](GridCell from, std::size_t k) {
    const GridCell to{from.x + kStepX[k], from.y + kStepY[k]};
    return search_.contains(to) && passable(from) && passable(to) &&
           map_edge_open(search_.index(from), search_.index(to), k);
  };
  const auto neighbour = [&](std::size_t k) { return GridCell{x + kStepX[k], y + kStepY[k]}; };
  unsigned mask = 0;
  for (std::size_t k = 0; k < 8; k += 2)
    if (link_open({x, y}, k)) mask |= 1U << k;
  for (std::size_t k = 1; k < 8; k += 2) {
    const std::size_t a = k - 1, b = (k + 1) % 8;
    if ((mask >> a & 1) == 0 || (mask >> b & 1) == 0) continue;
    if (link_open({x, y}, k) && link_open(neighbour(a), b) && link_open(neighbour(b), a)) mask |= 1U << k;
  }
  return static_cast<std::uint8_t>(mask);
}
}  // namespace floornav
