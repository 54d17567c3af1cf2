#include "runtime/geometry/lattice.hpp"

#include <cmath>

namespace floornav {

std::int32_t Lattice::index_of(double coordinate_m) const {
  return static_cast<std::int32_t>(std::floor(coordinate_m / pitch_m));
}

}  // namespace floornav
