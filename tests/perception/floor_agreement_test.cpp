#include "perception/floor_agreement.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr float kCertainty_m = 600.0F;  // a Kinect's

/// Pixels of a plane; what they show of it leans by `error_rad` about the patch's centre column.
struct Patch {
  InverseDepthPlane shown;
  PlaneFit fit;

  Patch(const InverseDepthPlane& plane, float x_begin, float x_end, float y_begin, float y_end,
        float error = 0.0F) {
    const float middle = 0.5F * (x_begin + x_end);
    for (float x = x_begin; x < x_end; x += 1.0F / 525.0F)
      for (float y = y_begin; y < y_end; y += 1.0F / 525.0F)
        fit.add(x, y, plane.inverse_depth(x, y) + error * (x - middle), kCertainty_m * kCertainty_m);
    shown = fit.solve().value();
  }
};

/// A sensor 1 m above a floor that it sees under this pitch.
InverseDepthPlane floor_below(double pitch_deg, double height_m = 1.0) {
  const double pitch = pitch_deg * std::numbers::pi / 180.0;
  return {0.0F, static_cast<float>(std::cos(pitch) / height_m),
          static_cast<float>(std::sin(pitch) / height_m)};
}

double angle_deg(const InverseDepthPlane& a, const InverseDepthPlane& b) {
  return std::acos(std::min(1.0, static_cast<double>(a.normal().dot(b.normal())))) * 180.0 / std::numbers::pi;
}

TEST(FloorAgreement, ASmallPatchTakesTheTiltOfTheWholeFloorAndKeepsItsHeight) {
  const InverseDepthPlane floor = floor_below(40.0);
  const Patch large(floor, -0.5F, 0.3F, -0.2F, 0.4F), small(floor, 0.4F, 0.45F, -0.1F, 0.3F, 0.1F);
  ASSERT_GT(angle_deg(small.shown, floor), 4.0);
  FloorAgreement agreement;
  agreement.add(large.fit);
  agreement.add(small.fit);
  const InverseDepthPlane settled = agreement.settle(small.fit, small.shown);
  EXPECT_LT(angle_deg(settled, floor), 1.5);
  EXPECT_NEAR(1.0F / settled.inverse_depth(0.425F, 0.1F), 1.0F / floor.inverse_depth(0.425F, 0.1F), 0.001F);
  const InverseDepthPlane large_settled = agreement.settle(large.fit, large.shown);
  EXPECT_LT(angle_deg(large_settled, floor), 0.05);
}

TEST(FloorAgreement, ARampKeepsItsSlope) {
  const InverseDepthPlane floor = floor_below(40.0), ramp = floor_below(46.0, 1.1);
  const Patch level(floor, -0.5F, 0.5F, 0.0F, 0.4F), sloped(ramp, -0.5F, 0.5F, -0.4F, 0.0F);
  FloorAgreement agreement;
  agreement.add(level.fit);
  agreement.add(sloped.fit);
  EXPECT_LT(angle_deg(agreement.settle(sloped.fit, sloped.shown), ramp), 1e-2);
  EXPECT_LT(angle_deg(agreement.settle(level.fit, level.shown), floor), 1e-2);
}

TEST(FloorAgreement, AloneAPatchIsAsItIs) {
  const InverseDepthPlane floor = floor_below(30.0);
  const Patch patch(floor, 0.0F, 0.1F, 0.0F, 0.1F, 0.05F);
  EXPECT_LT(angle_deg(FloorAgreement().settle(patch.fit, patch.shown), patch.shown), 1e-6);
  FloorAgreement agreement;
  agreement.add(patch.fit);
  EXPECT_LT(angle_deg(agreement.settle(patch.fit, patch.shown), patch.shown), 0.05);
}

}  // namespace
}  // namespace floornav
