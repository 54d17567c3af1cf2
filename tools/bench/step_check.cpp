#include "tools/bench/step_check.hpp"

#include <cmath>
#include <optional>

namespace floornav {
namespace {

constexpr double kSide_m = 0.1;     ///< of the places compared, before and behind an edge
constexpr double kAlong_m = 0.15;   ///< between places along an edge
constexpr double kFarther_m = 0.2;  ///< where nothing is known there, the next vertex up to so far away
constexpr double kFalseDifference_m = 0.005;

std::optional<double> height_at(const GridMap& map, const Eigen::Vector2d& place) {
  const CellIndex cell = map.lattice().cell_of(place.x(), place.y());
  const GridTile* tile = map.find(GridMap::tile_of(cell));
  if (tile == nullptr) return std::nullopt;
  const std::int32_t index = GridTile::index_of(cell);
  if (tile->state[static_cast<std::size_t>(index)] == VertexState::kUnknown) return std::nullopt;
  return static_cast<double>(tile->height_m(index));
}

/// The number of the neighbour in direction (x, y), each -1, 0 or 1.
int neighbour_of(std::int32_t x, std::int32_t y) {
  for (int k = 0; k < 8; ++k)
    if (kNeighbourX[static_cast<std::size_t>(k)] == x && kNeighbourY[static_cast<std::size_t>(k)] == y)
      return k;
  return 0;
}

std::int32_t sign(std::int32_t x) {
  return (x > 0) - (x < 0);
}

/// Whether an edge between known vertices is closed on the straight chain from one place to another.
bool has_closed_edge(const GridMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  CellIndex cell = map.lattice().cell_of(from.x(), from.y());
  const CellIndex end = map.lattice().cell_of(to.x(), to.y());
  while (!(cell == end)) {
    const CellIndex next{cell.ix + sign(end.ix - cell.ix), cell.iy + sign(end.iy - cell.iy)};
    if (map.state(cell) != VertexState::kUnknown && map.state(next) != VertexState::kUnknown) {
      const GridTile& tile = *map.find(GridMap::tile_of(cell));
      const std::uint8_t edges = tile.edges[static_cast<std::size_t>(GridTile::index_of(cell))];
      if ((edges >> neighbour_of(next.ix - cell.ix, next.iy - cell.iy) & 1) == 0) return true;
    }
    cell = next;
  }
  return false;
}

/// Height of the first known vertex from a place on, going away from the edge.
std::optional<double> first_height(const GridMap& map, const Eigen::Vector2d& place,
                                   const Eigen::Vector2d& away) {
  for (double distance_m = 0; distance_m <= kFarther_m; distance_m += map.lattice().pitch_m)
    if (const auto z = height_at(map, place + distance_m * away)) return z;
  return std::nullopt;
}

}  // namespace

bool shows_step(const GridMap& map, const StepEdge& edge) {
  const Eigen::Vector2d along(-edge.across.y(), edge.across.x());
  int places = 0;
  int shown = 0;
  for (int k = -2; k <= 2; ++k) {
    const Eigen::Vector2d place = edge.middle_m + k * kAlong_m * along;
    const Eigen::Vector2d before = place - kSide_m * edge.across;
    const Eigen::Vector2d behind = place + (kSide_m + edge.hidden_m) * edge.across;
    const auto near = first_height(map, before, -edge.across);
    const auto far = first_height(map, behind, edge.across);
    ++places;
    const bool right_height =
        near && far && std::fabs(*far - *near - edge.rise_m) <= 0.5 * std::fabs(edge.rise_m);
    if (right_height || has_closed_edge(map, before, behind)) ++shown;
  }
  return 2 * shown >= places;
}

PlainCheck check_plain(const GridMap& map, const Ground& ground) {
  PlainCheck check;
  const auto spacing = static_cast<std::int32_t>(std::lround(PlainCheck::kSpacing_m / map.lattice().pitch_m));
  for (const CellIndex tile : map.sorted_tiles()) {
    for (std::int32_t j = 0; j < GridTile::kSide; j += spacing) {
      for (std::int32_t i = 0; i < GridTile::kSide; i += spacing) {
        const Eigen::Vector2d here(map.lattice().center_of(tile.ix * GridTile::kSide + i),
                                   map.lattice().center_of(tile.iy * GridTile::kSide + j));
        const auto z = height_at(map, here);
        if (!z) continue;
        ++check.places;
        bool alarm = false;
        for (const Eigen::Vector2d& step :
             {Eigen::Vector2d(PlainCheck::kSpacing_m, 0), Eigen::Vector2d(0, PlainCheck::kSpacing_m)}) {
          const auto other = height_at(map, here + step);
          if (!other) continue;
          const double wrong_m = *other - *z - ground.slope.dot(step);
          alarm =
              alarm || std::fabs(wrong_m) >= kFalseDifference_m || has_closed_edge(map, here, here + step);
        }
        check.alarms += alarm ? 1 : 0;
      }
    }
  }
  return check;
}

}  // namespace floornav
