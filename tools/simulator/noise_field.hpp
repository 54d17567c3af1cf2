#pragma once

#include <cstdint>
#include <vector>

namespace floornav {

/// An image of standard normal numbers, independent or alike within windows.
class NoiseField {
 public:
  /// `correlation_px` 1: independent; n: each value is the scaled sum over an n x n window of independent
  /// ones.
  NoiseField(int width, int height, int correlation_px);

  /// The field of one key, row by row; valid until the next call.
  const std::vector<float>& draw(std::uint64_t key);

 private:
  int width_;
  int height_;
  int window_;
  std::vector<float> field_;
  std::vector<float> white_row_;
  std::vector<float> row_sums_;  ///< of the last `window_` rows
  std::vector<float> column_sum_;
};

}  // namespace floornav
