#include "tools/simulator/shapes.hpp"

#include <cmath>

namespace floornav {
namespace {

/// Place within the wave, in [0, 1).
double phase_of(const Waves& waves, double local_x) {
  const double turns = (local_x / waves.footprint.half_m.x() + 1.0) * 0.5 * waves.count;
  return turns - std::floor(turns);
}

}  // namespace

// One wave is 16 s^2 (1 - s)^2: smooth, 0 at both ends, 1 in the middle.
double Waves::top_at(double local_x) const {
  const double s = phase_of(*this, local_x);
  const double bump = 4.0 * s * (1.0 - s);
  return base_m + amplitude_m * bump * bump;
}

double Waves::slope_at(double local_x) const {
  const double s = phase_of(*this, local_x);
  const double turns_per_m = 0.5 * count / footprint.half_m.x();
  return amplitude_m * 32.0 * s * (1.0 - s) * (1.0 - 2.0 * s) * turns_per_m;
}

}  // namespace floornav
