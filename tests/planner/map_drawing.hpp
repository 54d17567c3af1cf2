#pragma once

#include <random>
#include <string>
#include <vector>

#include "mapping/grid_map.hpp"

namespace floornav {

/// Marks a cell as the mapper would: level floor of full belief, or an obstacle; `map.version` is its tile's
/// version.
inline void set_cell(GridMap& map, CellIndex cell, VertexState state) {
  GridTile& tile = map.make(GridMap::tile_of(cell));
  const auto i = static_cast<std::size_t>(GridTile::index_of(cell));
  tile.version = map.version;
  tile.state[i] = state;
  tile.belief[i] = state == VertexState::kFree ? 255 : 0;
  tile.edges[i] = state == VertexState::kFree ? 0xFF : 0;
}

/// Closes the edge from a cell to its neighbour k in both directions.
inline void close_edge(GridMap& map, CellIndex cell, unsigned k) {
  const auto clear = [&](CellIndex c, unsigned bit) {
    GridTile& tile = map.make(GridMap::tile_of(c));
    tile.version = map.version;
    tile.edges[static_cast<std::size_t>(GridTile::index_of(c))] &= static_cast<std::uint8_t>(~(1U << bit));
  };
  clear(cell, k);
  clear({cell.ix + kNeighbourX[k], cell.iy + kNeighbourY[k]}, (k + 4) % 8);
}

/// A map from a drawing: row 0 is y = 0, '.' free, '#' blocked, ' ' unknown.
inline GridMap draw_map(const std::vector<std::string>& rows, double resolution_m) {
  GridMap map(resolution_m);
  map.version = 1;
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x) {
      const CellIndex cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
      if (rows[y][x] != ' ')
        set_cell(map, cell, rows[y][x] == '.' ? VertexState::kFree : VertexState::kBlocked);
    }
  return map;
}

/// A field of free cells with blocked and unknown rectangles and closed edges, around the origin of the local
/// frame.
inline GridMap random_map(std::mt19937& random, std::int32_t half_side, double resolution_m,
                          bool with_unknown) {
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  GridMap map(resolution_m);
  map.version = 1;
  for (std::int32_t y = -half_side; y < half_side; ++y)
    for (std::int32_t x = -half_side; x < half_side; ++x) set_cell(map, {x, y}, VertexState::kFree);
  const auto rectangles = [&](int count, int largest, VertexState state) {
    for (int n = 0; n < count; ++n) {
      const std::int32_t x0 = uniform(-half_side, half_side - 1), y0 = uniform(-half_side, half_side - 1);
      const std::int32_t w = uniform(1, largest), h = uniform(1, largest);
      for (std::int32_t y = y0; y < std::min(y0 + h, half_side); ++y)
        for (std::int32_t x = x0; x < std::min(x0 + w, half_side); ++x) set_cell(map, {x, y}, state);
    }
  };
  if (with_unknown) rectangles(uniform(0, half_side / 4), 12, VertexState::kUnknown);
  rectangles(uniform(0, half_side / 2), 8, VertexState::kBlocked);
  const int closed = uniform(0, half_side * half_side / 8);
  for (int n = 0; n < closed; ++n) {
    const CellIndex cell{uniform(-half_side + 1, half_side - 2), uniform(-half_side + 1, half_side - 2)};
    close_edge(map, cell, static_cast<unsigned>(uniform(0, 7)));
  }
  return map;
}

}  // namespace floornav
