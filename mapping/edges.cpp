#include "mapping/edges.hpp"

#include <cmath>

namespace floornav {
namespace {

constexpr std::uint8_t bit(std::size_t k) {
  return static_cast<std::uint8_t>(1U << (k & 7U));
}

bool step_open(const VertexRef& from, std::size_t k) {
  return ((*from.tile->steps_open)[from.index()] & bit(k)) != 0;
}

/// The edge to side neighbour k of a free vertex.
bool side_open(const VertexRef& from, std::size_t k) {
  return step_open(from, k) && from.neighbour(k & 7U).vertex().is(Vertex::kFree);
}

/// The ways around the corner are looked at from both ends: a step is open in both directions.
bool diagonal_open(const VertexRef& from, std::size_t k, std::uint8_t sides) {
  if ((sides & bit(k - 1)) == 0 || (sides & bit(k + 1)) == 0 || !step_open(from, k)) return false;
  const VertexRef to = from.neighbour(k);
  return to.vertex().is(Vertex::kFree) && step_open(to, k + 3) && step_open(to, k + 5);
}

/// Whether there is no floor at a neighbour. Just behind an edge no sight line has fallen far: a vertex that
/// was not seen, with a drop on its other side, belongs to it.
bool begins_drop(const VertexRef& to, std::size_t k) {
  if (to.vertex().is(Vertex::kSeen)) return false;
  if (to.vertex().is(Vertex::kFloorEnds)) return true;
  if (k % 2 != 0) return false;
  const VertexRef next = to.neighbour(k);
  return next && next.vertex().is(Vertex::kFloorEnds) && !next.vertex().is(Vertex::kSeen);
}

bool on_border(const VertexRef& place) {
  const auto at_end = [](std::int32_t at) { return at == 0 || at == MapTile::kSide - 1; };
  return at_end(place.x) || at_end(place.y);
}

/// The edges that are not told anew because they, or a way around their corner, lead to a tile that is not
/// there or is not judged.
std::uint8_t towards_absent(const VertexRef& from, std::int64_t version) {
  if (!on_border(from)) return 0;
  std::uint8_t mask = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    const VertexRef to = from.neighbour(k);
    if (!to || to.tile->judged != version)
      mask |= static_cast<std::uint8_t>(k % 2 == 0 ? bit(k - 1) | bit(k) | bit(k + 1) : bit(k));
  }
  return mask;
}

}  // namespace

float StepRule::rise_m(const Surface& from, const Surface& to, std::size_t k) const {
  const float half_x_m = 0.5F * resolution_m * static_cast<float>(kNeighbourX[k]);
  const float half_y_m = 0.5F * resolution_m * static_cast<float>(kNeighbourY[k]);
  const float by_slope_m =
      (from.gradient_x + to.gradient_x) * half_x_m + (from.gradient_y + to.gradient_y) * half_y_m;
  return to.z_m - from.z_m - by_slope_m;
}

bool is_rim(const VertexRef& place, const StepRule& rule) {
  const Surface from = place.surface();
  for (std::size_t k = 0; k < 8; ++k) {
    if (step_open(place, k)) continue;  // drivable, and no step
    const VertexRef to = place.neighbour(k);
    if (!to) continue;
    if (begins_drop(to, k)) return true;
    if (!to.vertex().is(Vertex::kSeen)) continue;
    const Surface beside = to.surface();
    const float down_m = beside.column ? from.z_m - beside.z_m : -rule.rise_m(from, beside, k);
    if (down_m > 0 && !rule.climbs(down_m, from, beside)) return true;
    if (k % 2 == 0 && to.vertex().is(Vertex::kStepped) && std::abs(down_m) <= rule.max_step_m) return true;
  }
  return false;
}

void open_steps(MapTile& tile, const StepRule& rule) {
  tile.unfold();
  MapTile::Steps& steps = *tile.steps_open;
  const auto join = [&](const VertexRef& from, const Surface& surface, std::size_t k) {
    const VertexRef to = from.neighbour(k);
    const bool there = k >= 4 && to.tile == &tile;  // joined from there
    if (!to || there || !to.vertex().is(Vertex::kDrivable) || !rule.open(surface, to.surface(), k)) return;
    steps[from.index()] |= bit(k);
    if (to.tile == &tile) steps[to.index()] |= bit(k + 4);
  };
  for (std::int32_t y = 0; y < MapTile::kSide; ++y) {
    for (std::int32_t x = 0; x < MapTile::kSide; ++x) {
      const VertexRef from{&tile, x, y};
      if (!from.vertex().is(Vertex::kDrivable)) continue;
      const Surface surface = from.surface();
      for (std::size_t k = 0, end = on_border(from) ? 8 : 4; k < end; ++k) join(from, surface, k);
    }
  }
}

std::uint8_t open_edges(const VertexRef& from, std::int64_t version, std::uint8_t published) {
  if (!from.vertex().is(Vertex::kFree)) return 0;
  const std::uint8_t kept = towards_absent(from, version);
  auto mask = static_cast<std::uint8_t>(published & kept);
  for (std::size_t k = 0; k < 8; k += 2)
    if ((kept & bit(k)) == 0 && side_open(from, k)) mask |= bit(k);
  const std::uint8_t sides = mask;
  for (std::size_t k = 1; k < 8; k += 2)
    if ((kept & bit(k)) == 0 && diagonal_open(from, k, sides)) mask |= bit(k);
  return mask;
}

}  // namespace floornav
