#include "planner/search/grid_search.hpp"

namespace floornav {
namespace {

/// Measured on Moving AI's maps (floornav-bench planner) and on random fields of small obstacles: jump points
/// win by up to 80 times around walls, A* by up to 10 times among scattered cells, where its heuristic is
/// good and every obstacle makes eight places to turn.
constexpr double kMostTurnsPerCell = 0.6;
constexpr double kMostTurnsPerBorder = 1.45;

}  // namespace

GridSearch::Method GridSearch::choose(const SearchGrid& grid, const BitGrid* whole_projection) {
  if (!grid.weights.empty() || whole_projection == nullptr) return Method::kAStar;
  const bool scattered = whole_projection->turns_per_cell() > kMostTurnsPerCell ||
                         whole_projection->turns_per_border() > kMostTurnsPerBorder;
  return scattered ? Method::kAStar : Method::kJumpPoints;
}

SearchOutcome GridSearch::search(const SearchGrid& grid, const GridAids& aids, GridCell start, GridCell goal,
                                 const Interrupt& interrupt, OnNoPath on_no_path) {
  goal_ = goal;
  method_ = choose(grid, aids.whole_projection);
  if (method_ == Method::kJumpPoints) {
    const SearchOutcome outcome = jump_points_.search(*aids.whole_projection, start, goal, interrupt);
    if (outcome != SearchOutcome::kNoPath) return outcome;
    method_ = Method::kAStar;  // tells what else can be reached
  }
  return a_star_.search(grid, start, goal, interrupt, aids.blocks, on_no_path);
}

SearchOutcome GridSearch::shortest(const BitGrid& open_cells, GridCell start, GridCell goal,
                                   const Interrupt& interrupt) {
  goal_ = goal;
  method_ = Method::kJumpPoints;
  return jump_points_.search(open_cells, start, goal, interrupt);
}

void GridSearch::path(std::vector<GridCell>& path) const {
  method_ == Method::kJumpPoints ? jump_points_.path(path) : a_star_.path_to(goal_, path);
}

bool GridSearch::reached(GridCell cell) const {
  return method_ == Method::kAStar && a_star_.cost_of(cell) != AStar::kUnreached;
}

}  // namespace floornav
