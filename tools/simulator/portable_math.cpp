#include "tools/simulator/portable_math.hpp"

#include <cmath>

namespace floornav {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

/// Taylor series by Horner's rule, |x| <= pi/4: first term left out is below 1e-17.
double sine_series(double x) {
  const double y = x * x;
  double sum = 1.0;
  for (int k = 16; k >= 2; k -= 2) sum = 1.0 - y / (k * (k + 1)) * sum;
  return x * sum;
}

double cosine_series(double x) {
  const double y = x * x;
  double sum = 1.0;
  for (int k = 17; k >= 1; k -= 2) sum = 1.0 - y / (k * (k + 1)) * sum;
  return sum;
}

}  // namespace

SinCos sin_cos_deg(double degrees) {
  const double quarter = std::floor(degrees / 90.0 + 0.5);
  const double x = (degrees - 90.0 * quarter) * kRadPerDeg;
  const double s = sine_series(x);
  const double c = cosine_series(x);
  switch (static_cast<long long>(quarter) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace floornav
