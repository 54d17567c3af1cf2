#pragma once

#include <cstdint>
#include <vector>

namespace floornav {

/// A colour image the right way round.
struct ColorImage {
  int width = 0;                  ///< px
  int height = 0;                 ///< px
  std::vector<std::uint8_t> rgb;  ///< three bytes a pixel, row by row
  std::uint64_t stamp = 0;        ///< of the device's clock
};

}  // namespace floornav
