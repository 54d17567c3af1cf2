#pragma once

namespace floornav {

/// Sine and cosine of one angle.
struct SinCos {
  double sin = 0;
  double cos = 1;
};

/// From basic arithmetic alone, so that every machine gets the same bits (a C library picks its own by the
/// processor). Good to 1e-15 for |degrees| <= 1e6.
SinCos sin_cos_deg(double degrees);

}  // namespace floornav
