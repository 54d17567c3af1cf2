#include "mapping/cell_store.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace floornav {
namespace {

static_assert(Level::kMost < 16);
constexpr double kHeightUnits_per_m = 65536;
constexpr std::int32_t kMostHeight = (1 << 19) - 1;
constexpr float kMostRise = 2047;

/// Where the fields of a level begin in a word, and the bits that each of them has.
constexpr int kColumnBit = 6;
constexpr int kSupportBit = 7, kSupportBits = 4;
constexpr int kVarianceBit = 11, kVarianceBits = 9;
constexpr int kRiseYBit = 20, kRiseXBit = 32, kRiseBits = 12;
constexpr int kHeightBit = 44, kHeightBits = 20;

/// A variance keeps 4 bits of a float's mantissa, and of its exponents those from 2^-30 to 2^1.
constexpr int kDroppedBits = 19;
constexpr std::uint32_t kLeastVariance = (127U - 30U) << 4U;
constexpr std::uint32_t kMostVariance = (1U << kVarianceBits) - 1;

float rise_units(bool column) {
  return column ? 32.0F : 2048.0F;
}

std::uint64_t field(std::int32_t value, int bit, int bits) {
  return (static_cast<std::uint64_t>(value) & ((1ULL << bits) - 1)) << bit;
}

std::uint32_t unsigned_at(std::uint64_t word, int bit, int bits) {
  return static_cast<std::uint32_t>((word >> bit) & ((1ULL << bits) - 1));
}

std::int32_t signed_at(std::uint64_t word, int bit, int bits) {
  return static_cast<std::int32_t>(static_cast<std::int64_t>(word << (64 - bit - bits)) >> (64 - bits));
}

std::int32_t height_code(float z_m, std::int64_t level) {
  const double units = static_cast<double>(z_m) * kHeightUnits_per_m - static_cast<double>(level);
  const double within = std::clamp<double>(units, -kMostHeight, kMostHeight);
  return static_cast<std::int32_t>(within + (kMostHeight + 0.5)) - kMostHeight;
}

std::int32_t rise_code(float rise, float units) {
  const float within = std::clamp(rise * units, -kMostRise, kMostRise);
  return static_cast<std::int32_t>(within + (kMostRise + 0.5F)) - static_cast<std::int32_t>(kMostRise);
}

std::int32_t variance_code(float var_m2) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::max(var_m2, 0.0F));
  const std::uint32_t rounded = (bits + (1U << (kDroppedBits - 1))) >> kDroppedBits;
  return static_cast<std::int32_t>(std::clamp(rounded, kLeastVariance, kLeastVariance + kMostVariance) -
                                   kLeastVariance);
}

std::uint64_t packed(const Level& level, std::int64_t store_level) {
  if (!level.exists()) return 0;
  const float units = rise_units(level.column);
  return field(height_code(level.z_m, store_level), kHeightBit, kHeightBits) |
         field(rise_code(level.gradient_x, units), kRiseXBit, kRiseBits) |
         field(rise_code(level.gradient_y, units), kRiseYBit, kRiseBits) |
         field(variance_code(level.var_m2), kVarianceBit, kVarianceBits) |
         field(level.support, kSupportBit, kSupportBits) | field(level.column ? 1 : 0, kColumnBit, 1);
}

Level unpacked(std::uint64_t word, std::int64_t store_level) {
  Level level;
  level.support = static_cast<std::uint8_t>(unsigned_at(word, kSupportBit, kSupportBits));
  if (!level.exists()) return level;
  level.column = unsigned_at(word, kColumnBit, 1) != 0;
  const float unit = 1.0F / rise_units(level.column);
  level.z_m = static_cast<float>(static_cast<double>(store_level + signed_at(word, kHeightBit, kHeightBits)) /
                                 kHeightUnits_per_m);
  level.gradient_x = unit * static_cast<float>(signed_at(word, kRiseXBit, kRiseBits));
  level.gradient_y = unit * static_cast<float>(signed_at(word, kRiseYBit, kRiseBits));
  level.var_m2 =
      std::bit_cast<float>((unsigned_at(word, kVarianceBit, kVarianceBits) + kLeastVariance) << kDroppedBits);
  return level;
}

std::int64_t units_of(double z_m) {
  constexpr double kFarthest_m = 1e9;
  return std::llround(std::clamp(z_m, -kFarthest_m, kFarthest_m) * kHeightUnits_per_m);
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

CellStore::CellStore(std::size_t cells, double level_m) : words_(cells), level_(units_of(level_m)) {}

CellStore::CellStore(std::span<const CellMemory> cells) : CellStore(cells.size(), middle_of(cells)) {
  for (std::size_t slot = 0; slot < cells.size(); ++slot) set(slot, cells[slot]);
}

std::vector<CellStore::More>::const_iterator CellStore::place_of(std::size_t slot) const {
  return std::ranges::lower_bound(more_, slot, {}, &More::slot);
}

CellMemory CellStore::at(std::size_t slot) const {
  const std::uint64_t word = words_[slot];
  if (word == 0) return {};
  const Level lower = unpacked(word, level_);
  const auto no_return_frames = static_cast<std::uint8_t>(word & kNoReturn);
  if ((word & kMore) == 0) return {lower, {}, std::numeric_limits<float>::quiet_NaN(), no_return_frames};
  const More& more = *place_of(slot);
  return {lower, unpacked(more.upper, level_), more.overhead_z_m, no_return_frames};
}

void CellStore::set(std::size_t slot, const CellMemory& memory) {
  const bool more = memory.upper().exists() || !std::isnan(memory.overhead_z_m());
  if (more || has_more(slot)) set_more(slot, memory);
  words_[slot] = packed(memory.lower(), level_) | static_cast<std::uint64_t>(memory.no_return_frames()) |
                 (more ? kMore : 0);
}

void CellStore::set_more(std::size_t slot, const CellMemory& memory) {
  const auto place = more_.begin() + (place_of(slot) - more_.cbegin());
  const bool wanted = memory.upper().exists() || !std::isnan(memory.overhead_z_m());
  const More more{packed(memory.upper(), level_), memory.overhead_z_m(), static_cast<std::uint32_t>(slot)};
  if (!wanted) {
    more_.erase(place);
  } else if (has_more(slot)) {
    *place = more;
  } else {
    more_.insert(place, more);
  }
}

}  // namespace floornav
