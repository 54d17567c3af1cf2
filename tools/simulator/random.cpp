#include "tools/simulator/random.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace floornav {
namespace {

constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;
constexpr std::size_t kPairs = 64;

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// ln(x) for normal positive floats, to about 1e-7 relative.
inline float natural_log(float x) {
  // mantissa in [0.707, 1.414): the series converges fastest
  const auto bits = static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(x)) - 0x3F3504F3;
  const auto exponent = static_cast<float>(bits >> 23);
  const float mantissa = std::bit_cast<float>((bits & 0x007FFFFF) + 0x3F3504F3);
  const float s = (mantissa - 1.0F) / (mantissa + 1.0F);
  const float y = s * s;
  return exponent * 0.693147181F + 2.0F * s * (1.0F + y * (0.333333333F + y * (0.2F + y * 0.142857143F)));
}

/// Box and Muller: two uniform 24-bit numbers make two normal ones.
inline void normal_pair(std::uint32_t a, std::uint32_t b, float& first, float& second) {
  const float u = static_cast<float>(static_cast<std::int32_t>((a >> 8) + 1)) * 0x1p-24F;  // (0, 1]
  const float radius = std::sqrt(std::fmax(0.0F, -2.0F * natural_log(u)));
  const auto quarter = static_cast<std::int32_t>(b >> 30);
  const float x =
      (static_cast<float>(static_cast<std::int32_t>((b >> 7) & 0x7FFFFF)) * 0x1p-23F - 0.5F) * 1.57079633F;
  const float y = x * x;
  const float sine = x * (1.0F + y * (-0.166666667F + y * (8.33333333e-3F - y * 1.98412698e-4F)));
  const float cosine = 1.0F + y * (-0.5F + y * (4.16666667e-2F + y * (-1.38888889e-3F + y * 2.48015873e-5F)));
  const bool swap = (quarter & 1) != 0;
  const float sign = (quarter & 2) != 0 ? -radius : radius;
  first = sign * (swap ? cosine : sine);
  second = sign * (swap ? -sine : cosine);
}

}  // namespace

std::uint64_t random_key(std::initializer_list<std::uint64_t> parts) {
  std::uint64_t key = 0;
  for (const std::uint64_t part : parts) key = mix(key + kGolden + mix(part + kGolden));
  return key;
}

std::uint64_t random_bits(std::uint64_t key, std::uint64_t index) {
  return mix(key + (index + 1) * kGolden);
}

void fill_normals(std::uint64_t key, std::span<float> out) {
  std::array<std::uint32_t, kPairs> a{};
  std::array<std::uint32_t, kPairs> b{};
  std::array<float, 2 * kPairs> normals{};
  for (std::size_t start = 0; start < out.size(); start += 2 * kPairs) {
    for (std::size_t i = 0; i < kPairs; ++i) {
      const std::uint64_t bits = random_bits(key, start / 2 + i);
      a[i] = static_cast<std::uint32_t>(bits);
      b[i] = static_cast<std::uint32_t>(bits >> 32);
    }
    for (std::size_t i = 0; i < kPairs; ++i) normal_pair(a[i], b[i], normals[i], normals[kPairs + i]);
    const std::size_t count = std::min(out.size() - start, 2 * kPairs);
    for (std::size_t i = 0; i < count; ++i) out[start + i] = normals[i];
  }
}

void fill_uniforms(std::uint64_t key, std::span<float> out) {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<float>(static_cast<std::int32_t>(random_bits(key, i) >> 40)) * 0x1p-24F;
}

double RandomStream::uniform() {
  return static_cast<double>(random_bits(key_, next_++) >> 11) * 0x1p-53;
}

double RandomStream::normal() {
  const std::uint64_t bits = random_bits(key_, next_++);
  float first = 0;
  float second = 0;
  normal_pair(static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32), first, second);
  return static_cast<double>(first);
}

}  // namespace floornav
