#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "mapping/cell_memory.hpp"

namespace floornav {

/// A level in the upper 59 bits of a word, 0: none. Its height is told against a reference, in units of 15 um
/// up to kMostHeight of them: what is farther is taken to be that far. Rises of planes are kept to 1/1024 up
/// to 1, of columns to 1/16 up to 64, variances to 3 %.
class PackedLevel {
 public:
  static constexpr double kHeightUnits_per_m = 65536;
  static constexpr std::int32_t kMostHeight = (1 << 19) - 1;
  /// The bits below are somebody else's.
  static constexpr int kFreeBits = 5;

  constexpr explicit PackedLevel(std::uint64_t word) : word_(word) {}
  /// `reference`: in units of height.
  PackedLevel(const Level& level, std::int64_t reference) {
    if (!level.exists()) return;
    const float units = rise_units(level.column);
    word_ = field(height_code(level.z_m, reference), kHeightBit, kHeightBits) |
            field(rise_code(level.gradient_x, units), kRiseXBit, kRiseBits) |
            field(rise_code(level.gradient_y, units), kRiseYBit, kRiseBits) |
            field(variance_code(level.var_m2), kVarianceBit, kVarianceBits) |
            field(level.support, kSupportBit, kSupportBits) |
            field(level.column ? kColumn : level.reach, kReachBit, kReachBits);
  }

  [[nodiscard]] std::uint64_t word() const { return word_; }
  [[nodiscard]] std::int32_t support() const { return unsigned_at(kSupportBit, kSupportBits); }
  [[nodiscard]] Surface surface(std::int64_t reference) const {
    const std::int64_t height = reference + signed_at(kHeightBit, kHeightBits);
    const std::int32_t reach = signed_at(kReachBit, kReachBits);
    const bool column = reach == kColumn;
    const float unit = 1.0F / rise_units(column);
    const auto variance_bits =
        static_cast<std::uint32_t>(unsigned_at(kVarianceBit, kVarianceBits) + kLeastVariance);
    return {.z_m = static_cast<float>(static_cast<double>(height) / kHeightUnits_per_m),
            .var_m2 = std::bit_cast<float>(variance_bits << kDroppedBits),
            .gradient_x = unit * static_cast<float>(signed_at(kRiseXBit, kRiseBits)),
            .gradient_y = unit * static_cast<float>(signed_at(kRiseYBit, kRiseBits)),
            .column = column,
            .reach = static_cast<std::int8_t>(column ? 0 : reach)};
  }
  [[nodiscard]] Level level(std::int64_t reference) const {
    if (support() == 0) return {};
    return {surface(reference), static_cast<std::uint8_t>(support())};
  }

 private:
  /// Where the fields begin in the word, and the bits that each of them has.
  static constexpr int kSupportBit = kFreeBits, kSupportBits = 4;
  static constexpr int kVarianceBit = 9, kVarianceBits = 9;
  static constexpr int kReachBit = 18, kReachBits = 4;
  static constexpr int kRiseYBit = 22, kRiseXBit = 33, kRiseBits = 11;
  static constexpr int kHeightBit = 44, kHeightBits = 20;
  static_assert(Level::kMost < 1 << kSupportBits && Surface::kCorner < 1 << (kReachBits - 1));
  static constexpr std::int32_t kColumn = -(1 << (kReachBits - 1));  ///< instead of a reach

  static constexpr float kMostRise = 1023;
  /// A variance keeps 4 bits of a float's mantissa, and of its exponents those from 2^-30 to 2^1.
  static constexpr int kDroppedBits = 19;
  static constexpr std::int32_t kLeastVariance = (127 - 30) << 4;
  static constexpr std::int32_t kMostVariance = (1 << kVarianceBits) - 1;

  static constexpr float rise_units(bool column) { return column ? 16.0F : 1024.0F; }
  static std::uint64_t field(std::int32_t value, int bit, int bits) {
    return (static_cast<std::uint64_t>(value) & ((1ULL << bits) - 1)) << bit;
  }
  static std::int32_t height_code(float z_m, std::int64_t reference) {
    const double units = static_cast<double>(z_m) * kHeightUnits_per_m - static_cast<double>(reference);
    const double within = std::clamp<double>(units, -kMostHeight, kMostHeight);
    return static_cast<std::int32_t>(within + (kMostHeight + 0.5)) - kMostHeight;
  }
  static std::int32_t rise_code(float rise, float units) {
    const float within = std::clamp(rise * units, -kMostRise, kMostRise);
    return static_cast<std::int32_t>(within + (kMostRise + 0.5F)) - static_cast<std::int32_t>(kMostRise);
  }
  static std::int32_t variance_code(float var_m2) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::max(var_m2, 0.0F));
    const auto rounded = static_cast<std::int32_t>((bits + (1U << (kDroppedBits - 1))) >> kDroppedBits);
    return std::clamp(rounded - kLeastVariance, 0, kMostVariance);
  }
  [[nodiscard]] std::int32_t unsigned_at(int bit, int bits) const {
    return static_cast<std::int32_t>((word_ >> bit) & ((1ULL << bits) - 1));
  }
  [[nodiscard]] std::int32_t signed_at(int bit, int bits) const {
    return static_cast<std::int32_t>(static_cast<std::int64_t>(word_ << (64 - bit - bits)) >> (64 - bits));
  }

  std::uint64_t word_ = 0;
};

}  // namespace floornav
