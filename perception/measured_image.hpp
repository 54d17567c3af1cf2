#pragma once

#include <cstddef>
#include <vector>

namespace floornav {

/// What each pixel of a frame measured. Rows are padded with pixels that measured nothing, so that vectors
/// need no special case at their ends.
struct MeasuredImage {
  static constexpr std::size_t kPadding_px = 16;

  int width = 0;
  int height = 0;
  std::size_t stride = 0;            ///< places of a row
  std::vector<float> inverse_depth;  ///< 1/m; 0: nothing came back, or an absurd value
  std::vector<float> certainty;      ///< m: 1 / (1 sigma of inverse_depth), where something came back

  void resize(int new_width, int new_height) {
    width = new_width;
    height = new_height;
    stride = (static_cast<std::size_t>(width) + kPadding_px - 1) / kPadding_px * kPadding_px;
    inverse_depth.resize(stride * static_cast<std::size_t>(height));
    certainty.resize(inverse_depth.size());
  }
  [[nodiscard]] std::size_t row_begin(int row) const { return static_cast<std::size_t>(row) * stride; }
};

}  // namespace floornav
