#pragma once

#include <cstdint>

namespace floornav {

/// sRGB, 0..1 each.
struct Color {
  double red = 0;
  double green = 0;
  double blue = 0;
};

/// 0xRRGGBB.
constexpr Color color(std::uint32_t rgb) {
  return {((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0, (rgb & 255) / 255.0};
}

/// Between two colours; `fraction` 0 gives a, 1 gives b.
Color mix(Color a, Color b, double fraction);

/// Scales the colour's light, 1 = as it is.
Color shade(Color c, double light);

/// Perceptual colour map for a value in [0, 1]: lightness grows evenly (Oklab) while the hue turns from
/// violet over blue and green to yellow, so that equal differences look equal and a grey print keeps the
/// order.
Color perceptual_color(double value);

/// 0xFFRRGGBB, as cairo's RGB24 and ARGB32 images hold a pixel.
std::uint32_t packed(Color c);

}  // namespace floornav
