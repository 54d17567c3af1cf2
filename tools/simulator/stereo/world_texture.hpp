#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace floornav {

/// A grey pattern that covers every surface of the world, with details from 2 mm to metres. Seen from afar it
/// is averaged over a pixel's footprint, as by a lens.
class WorldTexture {
 public:
  explicit WorldTexture(std::uint64_t seed);

  /// Grey level around 0 at a place (m), averaged over about `footprint_m`.
  [[nodiscard]] float at(float x, float y, float z, float footprint_m) const;

 private:
  static constexpr int kLevels = 11;  ///< 1024 texels a side down to 1
  static constexpr float kTexel_m = 0.002F;

  [[nodiscard]] float at_level(int level, float u, float v) const;

  std::array<std::vector<float>, kLevels> levels_;  ///< repeat in both directions
};

}  // namespace floornav
