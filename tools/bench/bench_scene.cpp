#include "tools/bench/bench_scene.hpp"

namespace floornav {
namespace {

constexpr double kBelowGround_m = -1.0;

Block block(double x_m, double y_m, double length_m, double width_m, double height_m) {
  return {{{x_m, y_m}, {1, 0}, {0.5 * length_m, 0.5 * width_m}}, kBelowGround_m, height_m, {0, 0}};
}

}  // namespace

Shapes bench_scene() {
  constexpr double kRampSlope = 0.0875;  // 5 degrees
  Shapes shapes;
  shapes.blocks = {block(1.3, 0.3, 0.2, 0.2, 0.05),  block(1.7, -0.4, 0.25, 0.3, 0.10),
                   block(2.4, 0.7, 0.3, 0.2, 0.20),  block(3.1, -0.9, 0.3, 0.4, 0.40),
                   block(2.9, 0.1, 0.15, 0.2, 0.08), block(3.9, -0.2, 0.4, 0.3, 0.30),
                   block(3.5, 1.5, 1.4, 0.9, 0.01),  block(5.6, 0.0, 0.2, 8.0, 2.0)};
  Block ramp = block(4.2, -1.5, 1.2, 0.9, 0.6 * kRampSlope);
  ramp.slope.x() = kRampSlope;
  shapes.blocks.push_back(ramp);
  return shapes;
}

}  // namespace floornav
