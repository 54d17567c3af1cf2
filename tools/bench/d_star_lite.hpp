#pragma once

#include <cstdint>
#include <vector>

#include "planner/cell_rect.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

/// D* Lite (Koenig and Likhachev, AAAI 2002), optimized version: keeps the tree of a search from the goal and
/// mends it after changes. The planner searches afresh instead; this is the peer that the choice is measured
/// against.
class DStarLite {
 public:
  static constexpr std::uint32_t kUnreached = 0xFFFFFFFF;

  /// Searches anew. The grid must outlive the searches, and keep its size. Its edges are open both ways or
  /// none.
  void begin(const SearchGrid& grid, GridCell start, GridCell goal);
  /// Mends the search after edges or weights of the grid changed within `changed`, for a start that may have
  /// moved.
  void repair(GridCell start, const CellRect& changed);

  /// Of the cheapest way from the start to the goal; kUnreached where there is none.
  [[nodiscard]] std::uint32_t cost() const { return nodes_[grid_->index(start_)].rhs; }

 private:
  struct Node {
    std::uint32_t g = kUnreached;
    std::uint32_t rhs = kUnreached;
  };
  struct Waiting {
    std::uint64_t key;
    std::uint32_t item;
    friend bool operator>(const Waiting& a, const Waiting& b) { return a.key > b.key; }
  };

  void search();
  void settle(GridCell cell);
  [[nodiscard]] std::uint64_t key_of(GridCell cell) const;
  [[nodiscard]] std::uint32_t step(std::size_t from, std::size_t to, std::size_t k) const;
  void look_ahead(GridCell cell);
  void wait_if_uneven(GridCell cell);

  const SearchGrid* grid_ = nullptr;
  std::vector<std::uint8_t> edges_, weights_;  ///< as they were at the last search
  std::vector<Node> nodes_;
  std::vector<Waiting> queue_;
  GridCell start_, goal_;
  std::uint64_t moved_ = 0;  ///< k_m of the paper
};

}  // namespace floornav
