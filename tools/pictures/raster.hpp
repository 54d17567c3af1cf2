#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "mapping/grid_map.hpp"
#include "mapping/terrain_map.hpp"
#include "runtime/geometry/lattice.hpp"

namespace floornav {

/// A rectangle of lattice cells, dense; row 0 is the one with the lowest y.
struct CellRectangle {
  double resolution_m = 0.05;
  CellIndex first;  ///< cell of column 0, row 0
  int width = 0;    ///< cells along x
  int height = 0;   ///< cells along y

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] std::size_t index_of(CellIndex cell) const {
    return static_cast<std::size_t>(cell.iy - first.iy) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.ix - first.ix);
  }
  [[nodiscard]] double x_min_m() const { return first.ix * resolution_m; }
  [[nodiscard]] double y_min_m() const { return first.iy * resolution_m; }
  [[nodiscard]] double x_max_m() const { return (first.ix + width) * resolution_m; }
  [[nodiscard]] double y_max_m() const { return (first.iy + height) * resolution_m; }
};

/// The smallest rectangle that holds all cells given to it; 1 x 1 at the origin where there was none.
class CellBounds {
 public:
  void add(CellIndex cell);
  [[nodiscard]] CellRectangle rectangle(double resolution_m) const;

 private:
  bool empty_ = true;
  CellIndex least_;
  CellIndex most_;
};

/// The seen part of a grid-map.
struct MapRaster {
  CellRectangle cells;
  std::vector<VertexState> state;
  std::vector<std::uint8_t> belief;  ///< 0..255 for 0..1
  std::vector<float> height_m;       ///< NaN where unknown
};
/// All that was seen.
MapRaster rasterize(const GridMap& map);
/// A part of the map.
MapRaster rasterize(const GridMap& map, const CellRectangle& cells);

/// Heights on their own lattice.
struct HeightRaster {
  CellRectangle cells;
  std::vector<float> height_m;  ///< NaN where unknown
};
HeightRaster rasterize(const TerrainMap& map);

}  // namespace floornav
