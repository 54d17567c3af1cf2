#include "mapping/cell_memory.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {
namespace {

constexpr std::int32_t kSurePoints = 8;  ///< of a column: no depth edge throws so many into one cell

Level new_level(const Sighting& sighting) {
  Level level;
  static_cast<Surface&>(level) = sighting;
  level.support = static_cast<std::uint8_t>(std::clamp(sighting.points, 1, Level::kPerFrame));
  return level;
}

bool fits(const Level& level, const Surface& surface, const FusionLimits& limits) {
  if (!level.exists()) return false;
  const float gate_m = std::max(limits.gate_m, 3.0F * std::sqrt(level.var_m2 + surface.var_m2));
  return std::abs(level.z_m - surface.z_m) <= gate_m;
}

void blend(Surface& memory, const Surface& view, float memory_var_m2) {
  const float gain = memory.var_m2 / (memory.var_m2 + view.var_m2);
  const float above_m = (1.0F - gain) * memory.reach_m(1.0F) + gain * view.reach_m(1.0F);
  memory.z_m += gain * (view.z_m - memory.z_m);
  memory.gradient_x += gain * (view.gradient_x - memory.gradient_x);
  memory.gradient_y += gain * (view.gradient_y - memory.gradient_y);
  memory.set_reach(above_m, 1.0F);
  memory.var_m2 = std::max((1.0F - gain) * memory.var_m2, memory_var_m2);
}

/// Of one surface that was a plane to one and a column to the other: both know its height, the plane its
/// slope.
void join(Level& level, Surface view, float memory_var_m2) {
  Surface& column = level.column ? level : view;
  const Surface& plane = level.column ? view : level;
  column.gradient_x = plane.gradient_x;
  column.gradient_y = plane.gradient_y;
  column.reach = 0;
  column.column = false;
  blend(level, view, memory_var_m2);
}

/// A plane tells more than a column; of a column a lower view may have seen a part only, unless more points
/// speak for it than for a level that is not trusted.
bool tells_more(const Sighting& sighting, const Level& level) {
  if (!level.column) return false;
  return !sighting.column || sighting.z_m > level.z_m ||
         (!level.trusted() && sighting.points > level.support);
}

void support(Level& level, const Sighting& sighting, const FusionLimits& limits) {
  const std::int32_t sum = level.support + std::clamp(sighting.points, 1, Level::kPerFrame);
  if (!fits(level, sighting, limits)) {
    if (tells_more(sighting, level)) static_cast<Surface&>(level) = sighting;
  } else if (level.column == sighting.column) {
    blend(level, sighting, limits.memory_var_m2);
  } else {
    join(level, sighting, limits.memory_var_m2);
  }
  level.support = static_cast<std::uint8_t>(std::min(sum, Level::kMost));
}

/// A table top can be looked under: rays and floor far below a plane in its cell came in from the side and
/// say nothing of it.
bool looks_under(float z_m, const Level& level) {
  constexpr float kTable_m = 0.4F;
  return !level.column && level.z_m - z_m > kTable_m;
}

/// What a frame that did not see the level takes from its support.
std::int32_t doubt(const Level& level, const CellView& view, const FusionLimits& limits) {
  constexpr float kMuchSharper = 4.0F;
  const bool ray_below = view.ray_z_m < level.z_m - limits.ray_margin_m;
  std::int32_t doubt = ray_below && !looks_under(view.ray_z_m, level) ? 1 : 0;
  for (const Sighting& sighting : view.sightings) {
    if (sighting.column || sighting.z_m >= level.z_m || fits(level, sighting, limits)) continue;
    if (looks_under(sighting.z_m, level)) continue;
    const bool is_sharper = !sighting.in_part && kMuchSharper * sighting.var_m2 < level.var_m2;
    doubt = std::max(doubt, is_sharper ? 4 : 1);
  }
  return doubt;
}

/// The points of a sighting that count, where more than one frame is to tell.
std::int32_t counting_points(const Sighting& sighting, const Level& lower, const Level& upper,
                             const FusionLimits& limits) {
  if (!lower.trusted()) return sighting.points;
  if (!lower.column) return sighting.column && sighting.points < kSurePoints ? 1 : sighting.points;
  const bool raises =
      sighting.z_m > lower.z_m && !fits(lower, sighting, limits) && !fits(upper, sighting, limits);
  return raises ? std::min(sighting.points, Level::kTrusted - 1) : sighting.points;
}

void weaken(Level& level, std::int32_t doubt) {
  level.support = static_cast<std::uint8_t>(std::max(0, level.support - doubt));
}

}  // namespace

void CellMemory::place_above(const Sighting& sighting, Seen& seen) {
  const bool replaces = !upper_.exists() || (sighting.z_m > upper_.z_m &&
                                             (sighting.points >= Level::kTrusted || !upper_.trusted()));
  if (!replaces) return;
  upper_ = new_level(sighting);
  seen.upper = true;
}

void CellMemory::place_below(const Sighting& sighting, Seen& seen) {
  if (!upper_.exists()) {
    upper_ = lower_;
    seen.upper = lower_.exists() && seen.lower;
  }
  lower_ = new_level(sighting);
  seen.lower = true;
}

/// What stands out of a plane in the same view is not part of it, however uncertain the body's height is.
Level* CellMemory::level_of(const Sighting& sighting, const FusionLimits& limits, Seen seen) {
  const auto part_of = [&sighting](const Level& level) {
    return level.exists() && level.column && sighting.column && sighting.z_m <= level.z_m;
  };
  const auto holds = [&](const Level& level, bool is_seen) {
    const bool stands_out = is_seen && sighting.column && !level.column;
    return !stands_out && fits(level, sighting, limits);
  };
  const bool fits_upper = holds(upper_, seen.upper);
  const bool fits_lower = holds(lower_, seen.lower);
  const bool nearer_upper = std::abs(upper_.z_m - sighting.z_m) < std::abs(lower_.z_m - sighting.z_m);
  const bool confirms_upper = part_of(upper_) && (upper_.trusted() || !lower_.trusted() || !part_of(lower_));
  if (fits_upper ? !fits_lower || nearer_upper : !fits_lower && confirms_upper) return &upper_;
  const bool grows_lower =
      lower_.exists() && !lower_.trusted() && lower_.column && sighting.column && !upper_.exists();
  return fits_lower || part_of(lower_) || grows_lower ? &lower_ : nullptr;
}

void CellMemory::place(const Sighting& sighting, const FusionLimits& limits, Seen& seen) {
  if (Level* const level = level_of(sighting, limits, seen)) {
    support(*level, sighting, limits);
    (level == &upper_ ? seen.upper : seen.lower) = true;
  } else if (!lower_.exists() || sighting.z_m < lower_.z_m) {
    place_below(sighting, seen);
  } else {
    place_above(sighting, seen);
  }
}

bool CellMemory::forget_unseen(const CellView& view, const FusionLimits& limits, Seen seen) {
  const std::int32_t upper_doubt = upper_.exists() && !seen.upper ? doubt(upper_, view, limits) : 0;
  const std::int32_t lower_doubt = lower_.exists() && !seen.lower ? doubt(lower_, view, limits) : 0;
  weaken(upper_, upper_doubt);
  weaken(lower_, lower_doubt);
  if (!lower_.exists()) {
    lower_ = upper_;
    upper_ = Level{};
  }
  return upper_doubt + lower_doubt > 0;
}

bool CellMemory::doubt_unsettled_floor(const CellView& view, Seen seen) {
  if (!view.partly_hidden || seen.lower || !lower_.exists() || lower_.column ||
      lower_.support == Level::kMost)
    return false;
  weaken(lower_, Level::kPerFrame);
  return true;
}

void CellMemory::merge(const FusionLimits& limits) {
  if (upper_.column || lower_.column || !upper_.exists() || !fits(lower_, upper_, limits)) return;
  blend(lower_, upper_, limits.memory_var_m2);
  lower_.support = std::max(lower_.support, upper_.support);
  upper_ = Level{};
}

void CellMemory::lift(float by_m, float rise_x, float rise_y) {
  overhead_z_m_ += by_m;
  for (Level* const level : {&lower_, &upper_}) {
    level->z_m += by_m;
    if (level->column) continue;
    level->gradient_x += rise_x;
    level->gradient_y += rise_y;
  }
}

bool CellMemory::is_stepped(float max_step_m) const {
  if (!lower_.trusted() || !upper_.trusted()) return false;
  return upper_.z_m - lower_.z_m > max_step_m + 3.0F * std::sqrt(upper_.var_m2 + lower_.var_m2);
}

bool CellMemory::has_high_top() const {
  return upper_.exists() && lower_.exists() && looks_under(lower_.z_m, upper_);
}

void CellMemory::see_through_top() {
  weaken(upper_, 1);
}

void CellMemory::update_floor_doubt(const CellView& view, bool was_known) {
  constexpr std::int32_t kMostOfKnown = 2 * kOnEdge;
  std::int32_t doubt = floor_doubt_;
  if (view.sightings.empty()) {
    doubt += view.no_return ? 1 : 0;
  } else {
    doubt = was_known ? std::min(doubt, kMostOfKnown) : 0;
    doubt += view.on_edge ? kOnEdge : -1;
  }
  floor_doubt_ = static_cast<std::uint8_t>(std::clamp(doubt, 0, kMostFloorDoubt));
}

bool CellMemory::fuse(const CellView& view, const FusionLimits& limits) {
  Seen seen;
  const bool was_known = lower_.exists();
  const Level known_lower = lower_, known_upper = upper_;
  for (Sighting sighting : view.sightings) {
    sighting.points = counting_points(sighting, known_lower, known_upper, limits);
    place(sighting, limits, seen);
  }
  const bool doubted = forget_unseen(view, limits, seen) | doubt_unsettled_floor(view, seen);
  merge(limits);
  update_floor_doubt(view, was_known);
  return doubted || view.no_return || !view.sightings.empty();
}

}  // namespace floornav
