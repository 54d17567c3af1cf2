#include "planner/way_search.hpp"

namespace floornav {
namespace {

/// Jump points that the quick search may expand, some milliseconds' worth, in looks at its interrupt.
constexpr int kLooksOfQuickSearch = 200;

}  // namespace

SearchOutcome WaySearch::search(const PlanningGrid& grid, GridCell start, double heading_rad, GridCell goal,
                                const Interrupt& interrupt, OnNoPath on_no_path) {
  goal_ = goal;
  polygon_ = !grid.outline().is_circle();
  if (polygon_) return outline_search_.search(grid, start, heading_rad, goal, interrupt);
  return grid_search_.search(grid.search_grid(), grid.aids(), start, goal, interrupt, on_no_path);
}

bool WaySearch::shortest(const PlanningGrid& grid, GridCell start, GridCell goal) {
  if (polygon_) return false;
  int looks = 0;
  return grid_search_.shortest(grid.open_cells(), start, goal,
                               [&] { return ++looks > kLooksOfQuickSearch; }) == SearchOutcome::kFound;
}

void WaySearch::path(std::vector<GridCell>& path) const {
  polygon_ ? outline_search_.path_to(goal_, path) : grid_search_.path(path);
}

bool WaySearch::reached(GridCell cell) const {
  return polygon_ ? outline_search_.reached(cell) : grid_search_.reached(cell);
}

void WaySearch::path_to(GridCell cell, std::vector<GridCell>& path) const {
  polygon_ ? outline_search_.path_to(cell, path) : grid_search_.path_to(cell, path);
}

}  // namespace floornav
