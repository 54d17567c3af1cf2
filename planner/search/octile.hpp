#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "planner/search/search_grid.hpp"

namespace floornav {

/// Cost of the shortest way over an empty grid: a lower bound of any.
inline std::uint32_t octile(std::int32_t dx, std::int32_t dy, StepCosts steps) {
  const auto x = static_cast<std::uint32_t>(std::abs(dx));
  const auto y = static_cast<std::uint32_t>(std::abs(dy));
  return steps.straight * std::max(x, y) + (steps.diagonal - steps.straight) * std::min(x, y);
}

/// A cell as one number, as queues hold it.
inline std::uint32_t pack(GridCell cell) {
  return static_cast<std::uint32_t>(cell.x) | static_cast<std::uint32_t>(cell.y) << 16;
}
inline GridCell unpack(std::uint32_t item) {
  return {static_cast<std::int32_t>(item & 0xFFFF), static_cast<std::int32_t>(item >> 16)};
}

}  // namespace floornav
