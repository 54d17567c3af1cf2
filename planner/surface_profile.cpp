#include "planner/surface_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace floornav {
namespace {

constexpr int kHalf = 4;  ///< cells looked at before and behind a place
using Heights = std::array<double, 2 * kHalf + 1>;

const GridTile* free_vertex(const GridMap& map, double x_m, double y_m, std::size_t& vertex) {
  const CellIndex cell = map.lattice().cell_of(x_m, y_m);
  const GridTile* const tile = map.find(GridMap::tile_of(cell));
  vertex = static_cast<std::size_t>(GridTile::index_of(cell));
  return tile != nullptr && tile->state[vertex] == VertexState::kFree ? tile : nullptr;
}

/// Heights a cell apart along a line through (x, y); nothing where one of them was never seen.
std::optional<Heights> heights_along(const GridMap& map, double x_m, double y_m, double dx_m, double dy_m) {
  Heights heights;
  for (int i = -kHalf; i <= kHalf; ++i) {
    std::size_t vertex = 0;
    const GridTile* const tile = free_vertex(map, x_m + i * dx_m, y_m + i * dy_m, vertex);
    if (tile == nullptr) return std::nullopt;
    heights[static_cast<std::size_t>(i + kHalf)] =
        static_cast<double>(tile->height_m(static_cast<std::int32_t>(vertex)));
  }
  return heights;
}

/// The rise over two cells around the middle, of a place at `at`, that the slopes before and behind do not
/// explain.
double step_at(const Heights& z, std::size_t at) {
  const double before = 0.5 * (z[at - 1] - z[at - 3]), behind = 0.5 * (z[at + 3] - z[at + 1]);
  return std::abs(z[at + 1] - z[at - 1] - (before + behind));
}

/// Sum of the squared second differences: zero on a plane.
double unevenness(const Heights& z) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < z.size(); ++i) {
    const double bend = z[i] - 0.5 * (z[i - 1] + z[i + 1]);
    sum += bend * bend;
  }
  return sum / static_cast<double>(z.size() - 2);
}

}  // namespace

SurfaceProfile surface_profile(const GridMap& map, double x_m, double y_m, double heading_rad,
                               double track_m) {
  SurfaceProfile profile;
  std::size_t vertex = 0;
  if (const GridTile* const tile = free_vertex(map, x_m, y_m, vertex))
    profile.slope_deg = static_cast<double>(GridTile::kSlopeUnit_deg) * tile->slope[vertex];
  const double forward_x = std::cos(heading_rad), forward_y = std::sin(heading_rad);
  const double pitch_m = map.lattice().pitch_m;
  for (const double side_m : {-0.5 * track_m, 0.0, 0.5 * track_m}) {
    const auto heights = heights_along(map, x_m - side_m * forward_y, y_m + side_m * forward_x,
                                       pitch_m * forward_x, pitch_m * forward_y);
    if (!heights) continue;
    for (const std::size_t at : {kHalf - 1, kHalf, kHalf + 1})
      profile.step_m = std::max(profile.step_m, step_at(*heights, at));
    profile.roughness_m = std::max(profile.roughness_m, std::sqrt(unevenness(*heights)));
  }
  return profile;
}

}  // namespace floornav
