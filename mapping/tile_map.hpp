#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "runtime/geometry/lattice.hpp"

namespace floornav {

/// Square tiles of `Tile::kSide` x `Tile::kSide` cells over the local world frame, made on demand.
template <class Tile>
class TileMap {
 public:
  explicit TileMap(double resolution_m) : lattice_{resolution_m} {}

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  /// The tile that holds a cell.
  [[nodiscard]] static CellIndex tile_of(CellIndex cell) {
    return {block_of(cell.ix, Tile::kSide), block_of(cell.iy, Tile::kSide)};
  }
  /// The place of a cell in its tile's arrays.
  [[nodiscard]] static std::size_t index_of(CellIndex cell) {
    const CellIndex tile = tile_of(cell);
    const std::int32_t place =
        (cell.iy - tile.iy * Tile::kSide) * Tile::kSide + (cell.ix - tile.ix * Tile::kSide);
    return static_cast<std::size_t>(place);
  }
  /// Null where there is no tile.
  [[nodiscard]] const Tile* find(CellIndex tile) const {
    const auto it = tiles_.find(tile);
    return it == tiles_.end() ? nullptr : it->second.get();
  }
  [[nodiscard]] Tile* find(CellIndex tile) {
    const auto it = tiles_.find(tile);
    return it == tiles_.end() ? nullptr : it->second.get();
  }
  Tile& make(CellIndex tile) {
    auto& slot = tiles_[tile];
    if (!slot) slot = std::make_unique<Tile>();
    return *slot;
  }
  void erase(CellIndex tile) { tiles_.erase(tile); }
  void clear() { tiles_.clear(); }
  /// In no order; where the order reaches an output take sorted_tiles().
  [[nodiscard]] const std::unordered_map<CellIndex, std::unique_ptr<Tile>>& tiles() const { return tiles_; }
  [[nodiscard]] std::vector<CellIndex> sorted_tiles() const {
    std::vector<CellIndex> sorted;
    sorted.reserve(tiles_.size());
    for (const auto& [index, tile] : tiles_) sorted.push_back(index);
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  std::int32_t epoch = 0;    ///< counts pose jumps: nothing of an older epoch holds
  std::int64_t version = 0;  ///< counts updates

 private:
  Lattice lattice_;
  std::unordered_map<CellIndex, std::unique_ptr<Tile>> tiles_;
};

}  // namespace floornav
