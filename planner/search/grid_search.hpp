#pragma once

#include <memory>
#include <vector>

#include "planner/search/a_star.hpp"
#include "planner/search/grid_aids.hpp"
#include "planner/search/jump_point_search.hpp"

namespace floornav {

/// The cheapest way over a grid, by A* or by jump points, whichever is the quicker on such a grid.
class GridSearch {
 public:
  enum class Method : std::uint8_t { kAStar, kJumpPoints };

  /// Jump points, where they give A*'s answer (uniform cost, and a projection that is the whole grid) and the
  /// free cells are not scattered with small obstacles.
  [[nodiscard]] static Method choose(const SearchGrid& grid, const BitGrid* whole_projection);

  /// As AStar::search.
  SearchOutcome search(const SearchGrid& grid, const GridAids& aids, GridCell start, GridCell goal,
                       const Interrupt& interrupt = {}, OnNoPath on_no_path = OnNoPath::kSettleAll);
  /// By jump points whatever the costs: much quicker, and never over a closed edge.
  SearchOutcome shortest(const BitGrid& open_cells, GridCell start, GridCell goal,
                         const Interrupt& interrupt = {});

  /// Of the last search, after kFound. Replaces what `path` holds.
  void path(std::vector<GridCell>& path) const;
  /// Of the last search, after kNoPath, as AStar has it; where that was not told early, whether a way leads
  /// to the cell.
  [[nodiscard]] bool told_early() const { return method_ == Method::kAStar && a_star_.told_early(); }
  [[nodiscard]] bool on_goal_side(GridCell cell) { return a_star_.on_goal_side(cell); }
  [[nodiscard]] bool reached(GridCell cell) const;
  /// Of the last search: ends at another cell that it reached.
  void path_to(GridCell cell, std::vector<GridCell>& path) const { a_star_.path_to(cell, path); }
  /// Of the last search.
  [[nodiscard]] Method method() const { return method_; }

 private:
  std::shared_ptr<SearchCells> cells_ = std::make_shared<SearchCells>();
  AStar a_star_{cells_};
  JumpPointSearch jump_points_{cells_};
  Method method_ = Method::kAStar;
  GridCell goal_;
};

}  // namespace floornav
