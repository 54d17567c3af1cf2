#include "tools/pictures/color.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace floornav {
namespace {

/// CIE lightness L* of an sRGB colour: another perceptual scale than the one that the map is built on.
double cie_lightness(Color c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(PerceptualColor, GrowsLighterInEvenSteps) {
  constexpr int kSteps = 20;
  const double whole = cie_lightness(perceptual_color(1)) - cie_lightness(perceptual_color(0));
  EXPECT_GT(whole, 60);
  for (int i = 0; i < kSteps; ++i) {
    const double step = cie_lightness(perceptual_color((i + 1.0) / kSteps)) -
                        cie_lightness(perceptual_color(i * 1.0 / kSteps));
    EXPECT_GT(step, 0.5 * whole / kSteps) << i;
    EXPECT_LT(step, 1.6 * whole / kSteps) << i;
  }
}

TEST(PerceptualColor, StaysAtItsEndsOutside) {
  EXPECT_EQ(packed(perceptual_color(-3)), packed(perceptual_color(0)));
  EXPECT_EQ(packed(perceptual_color(7)), packed(perceptual_color(1)));
}

TEST(Colors, PackTheirBytesInOrder) {
  EXPECT_EQ(packed(color(0x12AB34)), 0xFF12AB34U);
}

}  // namespace
}  // namespace floornav
