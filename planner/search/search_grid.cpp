#include "planner/search/search_grid.hpp"

namespace floornav {

std::vector<std::uint8_t> edges_of_passable(const std::vector<std::uint8_t>& passable, std::int32_t width,
                                            std::int32_t height) {
  const auto open = [&](std::int32_t x, std::int32_t y) {
    return x >= 0 && y >= 0 && x < width && y < height &&
           passable[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)] != 0;
  };
  std::vector<std::uint8_t> edges(passable.size(), 0);
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x < width; ++x) {
      if (!open(x, y)) continue;
      unsigned mask = 0;
      for (std::size_t k = 0; k < 8; ++k) {
        const bool both_sides = open(x + kStepX[k], y) && open(x, y + kStepY[k]);
        if (open(x + kStepX[k], y + kStepY[k]) && both_sides) mask |= 1U << k;
      }
      edges[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
          static_cast<std::uint8_t>(mask);
    }
  }
  return edges;
}

}  // namespace floornav
