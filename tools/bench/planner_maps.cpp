#include "tools/bench/planner_maps.hpp"

#include <algorithm>

#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

constexpr double kPitch_m = 0.05;
constexpr std::int32_t kRoom = 100;  ///< cells
constexpr std::int32_t kDoor = 28;
constexpr std::int32_t kWall = 2;

void put(GridMap& map, CellIndex cell, VertexState state) {
  GridTile& tile = map.make(GridMap::tile_of(cell));
  const auto i = static_cast<std::size_t>(GridTile::index_of(cell));
  const bool free = state == VertexState::kFree;
  tile.version = map.version;
  tile.state[i] = state;
  tile.belief[i] = free ? 255 : 0;
  tile.edges[i] = free ? 0xFF : 0;
}

}  // namespace

void set_block(GridMap& map, CellIndex low, std::int32_t width, std::int32_t height, VertexState state) {
  ++map.version;
  for (std::int32_t y = low.iy; y < low.iy + height; ++y)
    for (std::int32_t x = low.ix; x < low.ix + width; ++x) put(map, {x, y}, state);
}

GridMap office_map(std::int32_t side, std::uint64_t seed) {
  RandomStream random(seed);
  const auto below = [&](std::int32_t n) { return random.below(n); };
  GridMap map(kPitch_m);
  set_block(map, {0, 0}, side, side, VertexState::kFree);
  const auto block = [&](std::int32_t x, std::int32_t y, std::int32_t w, std::int32_t h, VertexState state) {
    const std::int32_t x1 = std::min(x + w, side), y1 = std::min(y + h, side);
    if (x1 > x && y1 > y) set_block(map, {x, y}, x1 - x, y1 - y, state);
  };
  for (std::int32_t at = 0; at < side; at += kRoom) {
    block(at, 0, kWall, side, VertexState::kBlocked);
    block(0, at, side, kWall, VertexState::kBlocked);
  }
  for (std::int32_t y = 0; y < side; y += kRoom) {
    for (std::int32_t x = 0; x < side; x += kRoom) {
      const std::int32_t door = kWall + 4 + below(kRoom - kDoor - 8);
      if (x > 0 && below(100) < 85) block(x, y + door, kWall, kDoor, VertexState::kFree);
      if (y > 0 && below(100) < 85) block(x + door, y, kDoor, kWall, VertexState::kFree);
      for (int piece = 0; piece < 4; ++piece)
        block(x + 5 + below(80), y + 5 + below(80), 4 + below(12), 4 + below(12), VertexState::kBlocked);
    }
  }
  block(side - kWall, 0, kWall, side, VertexState::kBlocked);
  block(0, side - kWall, side, kWall, VertexState::kBlocked);
  return map;
}

SearchGrid upscaled(const SearchGrid& grid, std::int32_t factor) {
  SearchGrid large;
  large.width = grid.width * factor;
  large.height = grid.height * factor;
  large.whole_squares = true;
  std::vector<std::uint8_t> passable;
  passable.reserve(static_cast<std::size_t>(large.width) * static_cast<std::size_t>(large.height));
  for (std::int32_t y = 0; y < large.height; ++y)
    for (std::int32_t x = 0; x < large.width; ++x)
      passable.push_back(grid.edges[grid.index({x / factor, y / factor})] != 0 ? 1 : 0);
  large.edges = edges_of_passable(passable, large.width, large.height);
  return large;
}

}  // namespace floornav
