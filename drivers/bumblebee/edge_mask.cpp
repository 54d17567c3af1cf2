#include "drivers/bumblebee/edge_mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace floornav {
namespace {

// How far the window reaches, and the row that the last rounds have mixed in.
constexpr std::array<int, 3> kRows = {1, 2, 3};
constexpr std::array<int, 2> kColumns = {2, 4};
constexpr float kMostBend_px = 0.5F;  ///< second difference of disparity on one surface
constexpr float kMostTurn_px = 0.75F;

/// Marks where the pixels on opposite sides are not on a plane with the one between them.
void mark(const float* one, const float* here, const float* other, int columns, float most_px,
          std::uint8_t* edge) {
  for (int x = 0; x < columns; ++x) {
    const bool known = std::min(one[x], other[x]) > 0;
    const bool bent = std::abs(one[x] + other[x] - 2 * here[x]) > most_px;
    edge[x] = static_cast<std::uint8_t>(edge[x] | static_cast<std::uint8_t>(known & bent));
  }
}

}  // namespace

void mark_edges(const cv::Mat1f& disparity, int y, std::uint8_t* edge) {
  std::fill_n(edge, disparity.cols, std::uint8_t{0});
  const float* const here = disparity[y];
  for (const int rows : kRows)
    if (y >= rows && y + rows < disparity.rows)
      mark(disparity[y - rows], here, disparity[y + rows], disparity.cols, kMostBend_px, edge);
  for (const int columns : kColumns)
    mark(here, here + columns, here + 2 * columns, disparity.cols - 2 * columns, kMostTurn_px,
         edge + columns);
}

}  // namespace floornav
