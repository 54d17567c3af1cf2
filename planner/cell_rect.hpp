#pragma once

#include <algorithm>
#include <cstdint>

namespace floornav {

/// Cells [x0, x1) x [y0, y1).
struct CellRect {
  std::int32_t x0 = 0;
  std::int32_t y0 = 0;
  std::int32_t x1 = 0;
  std::int32_t y1 = 0;

  [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
  [[nodiscard]] std::int32_t width() const { return x1 - x0; }
  [[nodiscard]] std::int32_t height() const { return y1 - y0; }
  [[nodiscard]] bool contains(const CellRect& r) const {
    return r.x0 >= x0 && r.y0 >= y0 && r.x1 <= x1 && r.y1 <= y1;
  }
  [[nodiscard]] CellRect grown(std::int32_t by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
  [[nodiscard]] CellRect clipped(const CellRect& r) const {
    return {std::max(x0, r.x0), std::max(y0, r.y0), std::min(x1, r.x1), std::min(y1, r.y1)};
  }
  /// The smallest rectangle that holds both; an empty one adds nothing.
  [[nodiscard]] CellRect joined(const CellRect& r) const {
    if (empty()) return r;
    if (r.empty()) return *this;
    return {std::min(x0, r.x0), std::min(y0, r.y0), std::max(x1, r.x1), std::max(y1, r.y1)};
  }
};

}  // namespace floornav
