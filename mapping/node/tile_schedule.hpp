#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include <Eigen/Core>

#include "mapping/grid_map.hpp"

namespace floornav {

/// The tiles that come within `radius_m` of a place, sorted; all where the radius is negative.
template <class Tile>
std::vector<CellIndex> tiles_within(const TileMap<Tile>& map, const Eigen::Vector2d& center_m,
                                    double radius_m);

/// Which tiles are to be sent again although they have not changed, so that a receiver that came late or lost
/// messages is right again soon.
class TileSchedule {
 public:
  /// Every tile within this comes round in kTicksPerRound calls of due().
  static constexpr double kRadius_m = 20.0;
  static constexpr std::size_t kTicksPerRound = 16;

  /// Somebody asks for these.
  void request(const std::vector<CellIndex>& tiles) { requested_.insert(tiles.begin(), tiles.end()); }
  /// What to send now, sorted: the next share of those around the robot, and of those asked for.
  std::vector<CellIndex> due(const GridMap& map, const Eigen::Vector2d& robot_m);
  void clear() { requested_.clear(); }

 private:
  CellIndex last_sent_;
  std::set<CellIndex> requested_;
};

template <class Tile>
std::vector<CellIndex> tiles_within(const TileMap<Tile>& map, const Eigen::Vector2d& center_m,
                                    double radius_m) {
  if (radius_m < 0) return map.sorted_tiles();
  const double side_m = map.lattice().pitch_m * Tile::kSide;
  std::vector<CellIndex> tiles;
  const auto add_if_near = [&](CellIndex index) {
    const Eigen::Vector2d low(index.ix * side_m, index.iy * side_m);
    const Eigen::Vector2d high = low + Eigen::Vector2d::Constant(side_m);
    if ((center_m.cwiseMax(low).cwiseMin(high) - center_m).norm() <= radius_m) tiles.push_back(index);
  };
  const double tiles_across = 2 * radius_m / side_m + 2;
  if (tiles_across * tiles_across > static_cast<double>(map.tiles().size())) {
    for (const auto& [index, tile] : map.tiles()) add_if_near(index);
  } else {
    const Lattice lattice{side_m};
    const CellIndex first = lattice.cell_of(center_m.x() - radius_m, center_m.y() - radius_m);
    const CellIndex last = lattice.cell_of(center_m.x() + radius_m, center_m.y() + radius_m);
    for (std::int32_t iy = first.iy; iy <= last.iy; ++iy)
      for (std::int32_t ix = first.ix; ix <= last.ix; ++ix)
        if (map.find({ix, iy}) != nullptr) add_if_near({ix, iy});
  }
  std::ranges::sort(tiles);
  return tiles;
}

}  // namespace floornav
