#include "mapping/floor_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floornav {
namespace {

constexpr std::uint8_t kAllSides = 0b01010101;

bool step_open(const VertexRef& from, std::size_t k) {
  return (((*from.tile->steps_open)[from.index()] >> k) & 1U) != 0;
}

template <class Visit>
void for_each_vertex(MapTile& tile, Visit visit) {
  for (std::int32_t y = 0; y < MapTile::kSide; ++y)
    for (std::int32_t x = 0; x < MapTile::kSide; ++x) visit(VertexRef{&tile, x, y});
}

/// Calls visit(dx, dy) for each offset at Chebyshev distance `ring`.
template <class Visit>
void for_each_in_ring(std::int32_t ring, Visit visit) {
  for (std::int32_t dy = -ring; dy <= ring; ++dy) {
    const std::int32_t stride = std::abs(dy) == ring ? 1 : 2 * ring;
    for (std::int32_t dx = -ring; dx <= ring; dx += stride) visit(dx, dy);
  }
}

}  // namespace

FloorReach::FloorReach(const StepRule& rule, float max_rise)
    : rule_(rule), rise_per_vertex_m_(rule.resolution_m * max_rise) {
  constexpr float kContact_m = 0.25F;
  contact_range_ = std::clamp(static_cast<std::int32_t>(std::lround(kContact_m / rule.resolution_m)), 2, 10);
}

void FloorReach::grow(std::vector<MapTile*>& work, std::span<const VertexRef> seeds, std::int64_t version) {
  for (MapTile* tile : work)
    for (Vertex& vertex : tile->vertices) vertex.set(Vertex::kFloor, false);
  queue_.clear();
  for (std::size_t i = 0, judged = work.size(); i < judged; ++i) {
    MapTile* const tile = work[i];
    for_each_vertex(*tile, [&](const VertexRef& from) {
      for (std::size_t k = 0; k < 8; k += 2) {
        if (!step_open(from, k)) continue;
        const VertexRef to = from.neighbour(k);
        if (to.tile->judged != version && to.vertex().is(Vertex::kFloor)) enter(from, work, version);
      }
    });
  }
  for (const VertexRef& seed : seeds) enter(seed, work, version);
  spread(work, version);
}

void FloorReach::enter(const VertexRef& place, std::vector<MapTile*>& work, std::int64_t version) {
  if (place.vertex().is(Vertex::kFloor)) return;
  place.vertex().set(Vertex::kFloor, true);
  queue_.push_back(place);
  if (place.tile->judged == version) return;
  place.tile->judged = version;
  open_steps(*place.tile, rule_);
  work.push_back(place.tile);
}

void FloorReach::spread(std::vector<MapTile*>& work, std::int64_t version) {
  while (!queue_.empty()) {
    const VertexRef from = queue_.back();
    queue_.pop_back();
    for (std::size_t k = 0; k < 8; k += 2) {
      if (step_open(from, k)) enter(from.neighbour(k), work, version);
    }
  }
}

float FloorReach::unexplained_step(const VertexRef& from, std::int32_t dx, std::int32_t dy) const {
  const std::int32_t ring = std::max(std::abs(dx), std::abs(dy));
  std::int32_t unknown = 0;
  for (std::int32_t i = 1; i < ring; ++i) {
    const VertexRef between = from.moved(dx * i / ring, dy * i / ring);
    if (!between || !between.vertex().is(Vertex::kSeen)) ++unknown;
  }
  const float step_m = std::abs(from.moved(dx, dy).surface().z_m - from.surface().z_m);
  return step_m - rise_per_vertex_m_ * static_cast<float>(unknown == 0 ? 0 : unknown + 1);
}

FloorReach::Contact FloorReach::contact_of(const VertexRef& from) const {
  if (((*from.tile->steps_open)[from.index()] & kAllSides) == kAllSides) return Contact::kNone;
  for (std::int32_t ring = 1; ring <= contact_range_; ++ring) {
    float least_m = std::numeric_limits<float>::infinity();
    for_each_in_ring(ring, [&](std::int32_t dx, std::int32_t dy) {
      const VertexRef to = from.moved(dx, dy);
      if (to && to.vertex().is(Vertex::kFloor)) least_m = std::min(least_m, unexplained_step(from, dx, dy));
    });
    if (least_m > rule_.max_step_m && std::isfinite(least_m)) return Contact::kStep;
    if (std::isfinite(least_m)) return Contact::kLevel;
  }
  return Contact::kNone;
}

void FloorReach::find_cut_off(std::span<MapTile* const> work, std::int64_t version) {
  const auto open_question = [](const VertexRef& place) {
    return place.vertex().is(Vertex::kDrivable) && !place.vertex().is(Vertex::kFloor | Vertex::kAsked);
  };
  for (MapTile* tile : work)
    for (Vertex& vertex : tile->vertices) vertex.set(Vertex::kCutOff | Vertex::kAsked, false);
  for (MapTile* tile : work) {
    for_each_vertex(*tile, [&](const VertexRef& start) {
      if (open_question(start)) mark_part(start, version);
    });
  }
}

void FloorReach::mark_part(const VertexRef& start, std::int64_t version) {
  std::int64_t steps = 0;
  std::int64_t level = 0;
  const auto count = [&](bool is_step) { ++(is_step ? steps : level); };
  queue_.assign(1, start);
  start.vertex().set(Vertex::kAsked, true);
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const VertexRef from = queue_[next];
    const Contact contact = contact_of(from);
    if (contact != Contact::kNone) count(contact == Contact::kStep);
    for (std::size_t k = 0; k < 8; k += 2) {
      if (!step_open(from, k)) continue;
      const VertexRef to = from.neighbour(k);
      if (to.tile->judged != version) {
        count(to.vertex().is(Vertex::kCutOff));
      } else if (!to.vertex().is(Vertex::kAsked)) {
        to.vertex().set(Vertex::kAsked, true);
        queue_.push_back(to);
      }
    }
  }
  if (steps <= level) return;
  for (const VertexRef& member : queue_) member.vertex().set(Vertex::kCutOff, true);
}

bool FloorReach::beside_floor(const VertexRef& place) {
  bool beside = false;
  for (std::int32_t ring = 1; ring <= 2; ++ring) {
    for_each_in_ring(ring, [&](std::int32_t dx, std::int32_t dy) {
      const VertexRef to = place.moved(dx, dy);
      beside = beside || (to && to.vertex().is(Vertex::kFloor));
    });
  }
  return beside;
}

}  // namespace floornav
