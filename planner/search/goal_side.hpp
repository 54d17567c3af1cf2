#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/search/search_cells.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

/// The cells from which a goal can be reached, gathered bit by bit while a search from elsewhere goes on: if
/// they are all known and the search has come to none of them, there is no way. Marks them in the search's
/// own cells. For grids whose edges are open both ways.
class GoalSide {
 public:
  /// Nothing is gathered until begin() is called.
  void forget() { state_ = State::kUnknown, open_.clear(); }
  void begin(const SearchGrid& grid, SearchCells& cells, GridCell goal);
  /// Gathers some cells more.
  void gather(const SearchGrid& grid, SearchCells& cells, std::size_t count);

  /// They are all gathered, and the search's start is none of them.
  [[nodiscard]] bool shut_in() const { return state_ == State::kShutIn; }
  [[nodiscard]] bool contains(const SearchCells& cells, GridCell cell) const {
    return cells[cell].tag == cells.mark();
  }

 private:
  enum class State : std::uint8_t { kUnknown, kShutIn, kMet };

  State state_ = State::kUnknown;
  std::vector<std::uint32_t> open_;  ///< indices of cells marked whose neighbours are not yet
};

}  // namespace floornav
