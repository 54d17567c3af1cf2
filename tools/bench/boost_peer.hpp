#pragma once

#include <memory>
#include <optional>

#include "planner/search/search_grid.hpp"

namespace floornav {

/// Boost.Graph's A* on a compressed sparse row graph of the grid's cells that have steps, with the same costs
/// and the same heuristic. What depends on the map alone is made once.
class BoostPeer {
 public:
  explicit BoostPeer(const SearchGrid& grid);
  ~BoostPeer();
  BoostPeer(const BoostPeer&) = delete;
  BoostPeer& operator=(const BoostPeer&) = delete;

  /// Cost of the cheapest path, nothing where there is none.
  std::optional<std::uint32_t> search(GridCell start, GridCell goal);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace floornav
