#include "tools/simulator/stereo/world_texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

std::size_t texel(int size, int column, int row) {
  const int mask = size - 1;  // sizes are powers of 2
  return static_cast<std::size_t>((row & mask) * size + (column & mask));
}

}  // namespace

/// Each level is the coarser one, spread over twice the texels, plus noise of its own; then each becomes the
/// mean of the finer one, so that all show the same pattern.
WorldTexture::WorldTexture(std::uint64_t seed) {
  constexpr float kContrast = 16.0F;  // 1 sigma of each level's own noise, grey levels
  constexpr int kCoarsest = 7;        // with noise: cells of 0.26 m
  for (int level = kLevels - 1; level >= 0; --level) {
    const int size = 1 << (kLevels - 1 - level);
    auto& texels = levels_[static_cast<std::size_t>(level)];
    texels.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0.0F);
    if (level > kCoarsest) continue;
    fill_normals(random_key({seed, static_cast<std::uint64_t>(level)}), texels);
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const float coarser =
            levels_[static_cast<std::size_t>(level + 1)][texel(std::max(1, size / 2), column / 2, row / 2)];
        float& t = texels[texel(size, column, row)];
        t = coarser + kContrast * t;
      }
  }
  for (int level = 1; level < kLevels; ++level) {
    const int size = 1 << (kLevels - 1 - level);
    const auto& finer = levels_[static_cast<std::size_t>(level - 1)];
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column)
        levels_[static_cast<std::size_t>(level)][texel(size, column, row)] =
            0.25F *
            (finer[texel(2 * size, 2 * column, 2 * row)] + finer[texel(2 * size, 2 * column + 1, 2 * row)] +
             finer[texel(2 * size, 2 * column, 2 * row + 1)] +
             finer[texel(2 * size, 2 * column + 1, 2 * row + 1)]);
  }
}

float WorldTexture::at_level(int level, float u, float v) const {
  const int size = 1 << (kLevels - 1 - level);
  const auto& texels = levels_[static_cast<std::size_t>(level)];
  const float scale = 1.0F / static_cast<float>(1 << level);
  const float x = (u + 0.5F) * scale - 0.5F;
  const float y = (v + 0.5F) * scale - 0.5F;
  const float column = std::floor(x);
  const float row = std::floor(y);
  const float a = x - column;
  const float b = y - row;
  const auto i = static_cast<int>(column);
  const auto j = static_cast<int>(row);
  const float top = (1 - a) * texels[texel(size, i, j)] + a * texels[texel(size, i + 1, j)];
  const float bottom = (1 - a) * texels[texel(size, i, j + 1)] + a * texels[texel(size, i + 1, j + 1)];
  return (1 - b) * top + b * bottom;
}

float WorldTexture::at(float x, float y, float z, float footprint_m) const {
  const float wanted =
      std::clamp(std::log2(footprint_m / kTexel_m), 0.0F, static_cast<float>(kLevels) - 1.01F);
  const auto level = static_cast<int>(wanted);
  const float t = wanted - static_cast<float>(level);
  const auto pattern = [&](float u, float v) {
    return (1 - t) * at_level(level, u, v) + t * at_level(level + 1, u, v);
  };
  // two patterns that hang down askew, across each other: what sees one of them edge-on sees the other whole
  constexpr float kHalf = 0.7071F;  // of the variance
  return kHalf * (pattern((x + 0.71F * z) / kTexel_m, (y + 0.63F * z) / kTexel_m) +
                  pattern((x - 0.63F * z) / kTexel_m + 311, (y + 0.71F * z) / kTexel_m + 173));
}

}  // namespace floornav
