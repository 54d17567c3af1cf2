#pragma once

#include <algorithm>

namespace floornav {

/// An image's rows in bands, each one piece of work for the pool.
struct RowBands {
  static constexpr int kRows = 16;
  int height = 0;

  [[nodiscard]] int count() const { return (height + kRows - 1) / kRows; }
  [[nodiscard]] int first(int band) const { return band * kRows; }
  [[nodiscard]] int end(int band) const { return std::min((band + 1) * kRows, height); }
};

}  // namespace floornav
