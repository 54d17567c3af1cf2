#include "tools/pictures/color.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floornav {

namespace {

double gamma_encoded(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

/// Oklab lightness, chroma and hue (degrees) to sRGB, by the definition of Oklab.
Color from_oklch(double lightness, double chroma, double hue_deg) {
  const double a = chroma * std::cos(hue_deg * std::numbers::pi / 180);
  const double b = chroma * std::sin(hue_deg * std::numbers::pi / 180);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {gamma_encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          gamma_encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          gamma_encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Color mix(Color a, Color b, double fraction) {
  return {std::lerp(a.red, b.red, fraction), std::lerp(a.green, b.green, fraction),
          std::lerp(a.blue, b.blue, fraction)};
}

Color shade(Color c, double light) {
  return {std::clamp(c.red * light, 0.0, 1.0), std::clamp(c.green * light, 0.0, 1.0),
          std::clamp(c.blue * light, 0.0, 1.0)};
}

Color perceptual_color(double value) {
  const double t = std::clamp(value, 0.0, 1.0);
  return from_oklch(0.28 + 0.64 * t, 0.10 + 0.03 * std::sin(std::numbers::pi * t), 305 - 200 * t);
}

std::uint32_t packed(Color c) {
  const auto byte = [](double v) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255));
  };
  return 0xFF000000U | byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

}  // namespace floornav
