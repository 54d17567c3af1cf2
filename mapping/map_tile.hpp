#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/cell_store.hpp"
#include "mapping/grid_map.hpp"
#include "mapping/vertex.hpp"

namespace floornav {

/// The mapper's own side of a grid tile: memory of its lattice cells, its vertices, and links to the tiles
/// around it.
struct MapTile {
  static constexpr std::int32_t kSide = GridTile::kSide;

  CellIndex index;
  std::array<MapTile*, 8> neighbours{};  ///< as kNeighbourX, kNeighbourY; null where there is none yet
  CellStore cells;                       ///< vertex by vertex; those of a vertex row by row along x
  std::vector<Surface> surfaces;  ///< of the vertices, where several cells make one or while it is judged
  std::array<Vertex, GridTile::kVertices> vertices{};
  using Steps = std::array<std::uint8_t, GridTile::kVertices>;
  std::unique_ptr<Steps> steps_open;         ///< as GridTile::edges, by heights alone; while it is judged
  std::bitset<GridTile::kVertices> touched;  ///< have new evidence since the last refresh
  bool floor_is_known = false;               ///< woken: Vertex::kFloor is from before and seeds the floor
  bool overhead_moved = false;               ///< of some cell, since the last refresh
  bool high_tops = false;                    ///< some cell has had one: CellMemory::has_high_top()
  std::int64_t judged = -1;                  ///< map version at which it was last judged
  GridTile* grid = nullptr;                  ///< what is published of it

  /// Lays out what the judgement of all its vertices asks for again and again, and puts it away.
  void unfold();
  void fold();

  /// What decides in a vertex that was seen.
  [[nodiscard]] Surface surface(std::size_t vertex) const {
    return surfaces.empty() ? cells.decider(vertex).value_or(Surface{}) : surfaces[vertex];
  }
  /// z of the lowest thing above the robot's height; NaN: none.
  [[nodiscard]] float overhead_z_m(std::size_t vertex) const;
  /// When its vertices were seen last: as published, or its own until then.
  [[nodiscard]] GridTile::Seen& seen();
  [[nodiscard]] const GridTile::Seen& seen() const;
  /// From now on `tile` is what is published of it.
  void publish_in(GridTile& tile);

  [[nodiscard]] std::int64_t memory_bytes() const {
    const std::size_t own = (seen_ ? sizeof *seen_ : 0) + surfaces.capacity() * sizeof(Surface);
    return static_cast<std::int64_t>(sizeof(MapTile) + cells.memory_bytes() + own);
  }

 private:
  std::unique_ptr<GridTile::Seen> seen_;
};

/// A place in the map that can be walked from tile to tile without looking tiles up.
struct VertexRef {
  MapTile* tile = nullptr;
  std::int32_t x = 0;  ///< within the tile
  std::int32_t y = 0;

  [[nodiscard]] explicit operator bool() const { return tile != nullptr; }
  [[nodiscard]] std::size_t index() const {
    const std::int32_t place = y * MapTile::kSide + x;
    return static_cast<std::size_t>(place);
  }
  [[nodiscard]] Vertex& vertex() const { return tile->vertices[index()]; }
  [[nodiscard]] Surface surface() const { return tile->surface(index()); }

  /// The vertex `dx`, `dy` steps on, at most a tile's side; false where there is no tile.
  [[nodiscard]] VertexRef moved(std::int32_t dx, std::int32_t dy) const {
    constexpr std::array<std::int32_t, 9> kTowards{5, 6, 7, 4, -1, 0, 3, 2, 1};
    const std::int32_t to_x = x + dx;
    const std::int32_t to_y = y + dy;
    const auto inside = [](std::int32_t at) { return at >= 0 && at < MapTile::kSide; };
    if (inside(to_x) && inside(to_y)) return {tile, to_x, to_y};
    const std::int32_t tile_x = block_of(to_x, MapTile::kSide);
    const std::int32_t tile_y = block_of(to_y, MapTile::kSide);
    const std::int32_t direction = 3 * (tile_y + 1) + tile_x + 1;
    const std::int32_t towards = kTowards[static_cast<std::size_t>(direction)];
    MapTile* const to = towards < 0 ? tile : tile->neighbours[static_cast<std::size_t>(towards)];
    return {to, to_x - tile_x * MapTile::kSide, to_y - tile_y * MapTile::kSide};
  }
  [[nodiscard]] VertexRef neighbour(std::size_t k) const { return moved(kNeighbourX[k], kNeighbourY[k]); }
};

}  // namespace floornav
