#include "mapping/cell_store.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace floornav {
namespace {

std::int64_t units_of(double z_m) {
  constexpr double kFarthest_m = 1e9;
  return std::llround(std::clamp(z_m, -kFarthest_m, kFarthest_m) * PackedLevel::kHeightUnits_per_m);
}

/// Between the lowest and the highest of all levels.
double middle_of(std::span<const CellMemory> cells) {
  float lowest_m = std::numeric_limits<float>::infinity();
  float highest_m = -lowest_m;
  for (const CellMemory& cell : cells) {
    for (const Level* level : {&cell.lower(), &cell.upper()}) {
      if (!level->exists()) continue;
      lowest_m = std::min(lowest_m, level->z_m);
      highest_m = std::max(highest_m, level->z_m);
    }
  }
  return lowest_m > highest_m ? 0
                              : std::midpoint(static_cast<double>(lowest_m), static_cast<double>(highest_m));
}

}  // namespace

CellStore::CellStore(std::size_t cells, double level_m)
    : blocks_(cells / kBlock, kNoBlock), level_(units_of(level_m)) {}

CellStore::CellStore(std::span<const CellMemory> cells) : CellStore(cells.size(), middle_of(cells)) {
  for (std::size_t slot = 0; slot < cells.size(); ++slot) set(slot, cells[slot]);
}

std::vector<CellStore::More>::const_iterator CellStore::place_of(std::size_t slot) const {
  return std::ranges::lower_bound(more_, slot, {}, &More::slot);
}

CellMemory CellStore::at(std::size_t slot) const {
  const std::uint64_t own = word(slot);
  if (own == 0) return {};
  const auto floor_doubt = static_cast<std::int32_t>(own & kFloorDoubt);
  if ((own & kMore) == 0)
    return {PackedLevel(own).level(level_), {}, std::numeric_limits<float>::quiet_NaN(), floor_doubt};
  const More& more = *place_of(slot);
  return {PackedLevel(own).level(level_), PackedLevel(more.upper).level(level_), more.overhead_z_m,
          floor_doubt};
}

std::uint64_t CellStore::deciding_word(std::size_t slot) const {
  const std::uint64_t upper = place_of(slot)->upper;
  return PackedLevel(upper).support() >= Level::kTrusted ? upper : word(slot);
}

void CellStore::set(std::size_t slot, const CellMemory& memory) {
  const bool more = memory.upper().exists() || !std::isnan(memory.overhead_z_m());
  if (more || has_more(slot)) set_more(slot, memory);
  const std::uint64_t now = PackedLevel(memory.lower(), level_).word() |
                            static_cast<std::uint64_t>(memory.floor_doubt()) | (more ? kMore : 0);
  std::uint32_t& block = blocks_[block_of(slot)];
  if (block == kNoBlock && now == 0) return;
  if (block == kNoBlock) block = add_block();
  words_[block * kBlock + place_in_block(slot)] = now;
}

std::uint32_t CellStore::add_block() {
  const std::size_t before = words_.size();
  words_.reserve(before + kBlock);  // no more than that
  words_.resize(before + kBlock);
  return static_cast<std::uint32_t>(before / kBlock);
}

void CellStore::set_more(std::size_t slot, const CellMemory& memory) {
  const auto place = more_.begin() + (place_of(slot) - more_.cbegin());
  const bool wanted = memory.upper().exists() || !std::isnan(memory.overhead_z_m());
  const More more{PackedLevel(memory.upper(), level_).word(), memory.overhead_z_m(),
                  static_cast<std::uint32_t>(slot)};
  if (!wanted) {
    more_.erase(place);
  } else if (has_more(slot)) {
    *place = more;
  } else {
    more_.insert(place, more);
  }
}

}  // namespace floornav
