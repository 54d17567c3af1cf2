#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace floornav {

/// An uncertainty in one byte: counts up to 31 as they are, larger ones to 3 %, kUnknownSigma for no idea.
inline constexpr std::int16_t kUnknownSigma = std::numeric_limits<std::int16_t>::max();

constexpr std::int16_t sigma_counts(std::uint8_t code) {
  constexpr int kLargest = 191;
  if (code > kLargest) return kUnknownSigma;
  if (code < 32) return code;
  return static_cast<std::int16_t>((16 + code % 16) << (code / 16 - 1));
}

/// The inverse, rounding to the nearest; negative counts are none.
constexpr std::uint8_t sigma_code(std::int16_t counts) {
  constexpr int kLargestCounts = 31 << 10;
  if (counts > kLargestCounts) return counts == kUnknownSigma ? 255 : 191;
  if (counts < 32) return static_cast<std::uint8_t>(counts < 0 ? 0 : counts);
  const int halvings = static_cast<int>(std::bit_width(static_cast<unsigned>(counts))) - 5;
  const int rounded = (counts + (1 << (halvings - 1))) >> halvings;
  return static_cast<std::uint8_t>(16 * halvings + rounded);
}

}  // namespace floornav
