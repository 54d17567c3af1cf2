#include "mapping/belief.hpp"

#include <algorithm>
#include <cmath>

namespace floornav {

float height_term(float above_floor_m) {
  constexpr float kHighest_m = 0.75F;
  return std::max(0.0F, 1.0F - std::abs(above_floor_m) / kHighest_m);
}

float slope_term(float slope_deg) {
  constexpr float kSteep_deg = 60.0F;
  constexpr float kSteepest_deg = 75.0F;
  constexpr float kAtSteep = 0.2F;
  const float slope = std::abs(slope_deg);
  if (slope <= kSteep_deg) return 1.0F - (1.0F - kAtSteep) * slope / kSteep_deg;
  return std::max(0.0F, kAtSteep * (kSteepest_deg - slope) / (kSteepest_deg - kSteep_deg));
}

}  // namespace floornav
