#pragma once

#include <cstdint>

#include "mapping/grid_map.hpp"
#include "planner/search/search_grid.hpp"

namespace floornav {

/// A floor of an office building as a mapper would know it: rooms of 5 m with doors of 1.4 m, some shut, and
/// furniture. `side` cells of 0.05 m in a square from the origin on; a multiple of 32.
GridMap office_map(std::int32_t side, std::uint64_t seed);

/// Sets a rectangle of cells to free or blocked, as a later version of the map.
void set_block(GridMap& map, CellIndex low, std::int32_t width, std::int32_t height, VertexState state);

/// Every cell of a grid of blocked and free cells made to a square of `factor` x `factor`.
SearchGrid upscaled(const SearchGrid& grid, std::int32_t factor);

}  // namespace floornav
