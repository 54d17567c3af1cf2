#include "runtime/geometry/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floornav {

std::int32_t Lattice::index_of(double coordinate_m) const {
  constexpr double kLowest = std::numeric_limits<std::int32_t>::min();
  constexpr double kHighest = std::numeric_limits<std::int32_t>::max();
  const double index = std::floor(coordinate_m / pitch_m);
  if (!(index > kLowest)) return std::numeric_limits<std::int32_t>::min();
  return static_cast<std::int32_t>(std::min(index, kHighest));
}

}  // namespace floornav
