#include "mapping/floor_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mapping/floor_height.hpp"

namespace floornav {
namespace {

constexpr double kRadius_m = 2.5;
constexpr double kEnough_m2 = 0.05;
constexpr float kSearch_m = 0.10F;

struct Candidate {
  float above_plane_m;
  VertexRef place;
};

std::vector<Candidate> candidates(const Pose& T_world_body, const Lattice& lattice, const MapTiles& tiles) {
  const Eigen::Vector3d body = T_world_body.translation();
  const CellIndex first = lattice.cell_of(body.x() - kRadius_m, body.y() - kRadius_m);
  const CellIndex last = lattice.cell_of(body.x() + kRadius_m, body.y() + kRadius_m);
  std::vector<Candidate> found;
  for (std::int32_t iy = first.iy; iy <= last.iy; ++iy) {
    for (std::int32_t ix = first.ix; ix <= last.ix; ++ix) {
      const double x_m = lattice.center_of(ix);
      const double y_m = lattice.center_of(iy);
      const Eigen::Vector2d from_body = Eigen::Vector2d(x_m, y_m) - body.head<2>();
      if (from_body.squaredNorm() > kRadius_m * kRadius_m) continue;
      const VertexRef place = tiles.find_vertex({ix, iy});
      if (!place || !place.vertex().is(Vertex::kDrivable)) continue;
      const float above_m = place.surface().z_m - plane_height_m(T_world_body, x_m, y_m);
      if (std::abs(above_m) <= kSearch_m) found.push_back({above_m, place});
    }
  }
  return found;
}

/// Middle of the span of 2 T that holds the most candidates.
float commonest_level(std::vector<Candidate>& found, float max_step_m) {
  std::ranges::stable_sort(found, {}, &Candidate::above_plane_m);
  std::size_t most = 0;
  float level_m = 0;
  for (std::size_t first = 0, end = 0; first < found.size(); ++first) {
    while (end < found.size() && found[end].above_plane_m - found[first].above_plane_m <= 2 * max_step_m)
      ++end;
    if (end - first <= most) continue;
    most = end - first;
    level_m = 0.5F * (found[first].above_plane_m + found[end - 1].above_plane_m);
  }
  return level_m;
}

}  // namespace

std::vector<VertexRef> floor_seeds(const Pose& T_world_body, const Lattice& vertices, float max_step_m,
                                   const MapTiles& tiles) {
  std::vector<Candidate> found = candidates(T_world_body, vertices, tiles);
  const auto at_level = [&](float level_m) {
    std::vector<VertexRef> seeds;
    for (const Candidate& candidate : found)
      if (std::abs(candidate.above_plane_m - level_m) <= max_step_m) seeds.push_back(candidate.place);
    return seeds;
  };
  std::vector<VertexRef> seeds = at_level(0);
  const double area_m2 = static_cast<double>(seeds.size()) * vertices.pitch_m * vertices.pitch_m;
  if (area_m2 < kEnough_m2 && !found.empty()) seeds = at_level(commonest_level(found, max_step_m));
  return seeds;
}

}  // namespace floornav
