#include "mapping/told_height.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr float kMuchSharper = 4.0F;  ///< in variance

}  // namespace

Surface highest_place(const VertexRef& place, float resolution_m, float step_m) {
  Surface surface = place.surface();
  surface.z_m += surface.reach_m(resolution_m);
  float weights = 1.0F / surface.var_m2;
  float weighted_m = 0.0F;
  for (std::size_t k = 0; k < 8; ++k) {
    const VertexRef beside = place.neighbour(k);
    if (!beside || !beside.vertex().is(Vertex::kSeen)) continue;
    const Surface known = beside.surface();
    if (known.var_m2 <= 0 || kMuchSharper * known.var_m2 > surface.var_m2) continue;
    const float off_m = known.z_m - surface.z_m;
    const float noise_m = 3.0F * std::sqrt(known.var_m2 + surface.var_m2);
    if (std::abs(off_m) > std::min(noise_m, 0.5F * step_m)) continue;
    weights += 1.0F / known.var_m2;
    weighted_m += off_m / known.var_m2;
  }
  surface.z_m += weighted_m / weights;
  return surface;
}

}  // namespace floornav
