#include "perception/side_end.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr float kSigma_per_m = 0.068F / (575.0F * 0.075F);  // 1 sigma of inverse depth

DepthFrame kinect_frame() {
  DepthFrame frame;
  frame.camera = {575.0F, 575.0F, 319.5F, 239.5F, 640, 480};
  const double pitch = 20 * M_PI / 180;
  frame.T_body_sensor.linear().col(0) = -Eigen::Vector3d::UnitY();
  frame.T_body_sensor.linear().col(1) = Eigen::Vector3d(-std::sin(pitch), 0, -std::cos(pitch));
  frame.T_body_sensor.linear().col(2) = Eigen::Vector3d(std::cos(pitch), 0, -std::sin(pitch));
  frame.T_body_sensor.translation().z() = 0.72;
  return frame;
}

/// A box with its side at x = distance_m, seen by rays: closed form, and noise on the inverse depth.
struct Scene {
  double distance_m = 4.0;
  double height_m = 0.2;
  double length_m = 0.3;  ///< of its top

  [[nodiscard]] MeasuredImage seen(const SensorView& view, unsigned seed, float sigma) const {
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0.0F, sigma);
    MeasuredImage image;
    image.resize(view.camera.width, view.camera.height);
    const Eigen::Vector3d eye = view.T_world_sensor.translation();
    for (int v = 0; v < image.height; ++v)
      for (int u = 0; u < image.width; ++u) {
        const Eigen::Vector3d ray =
            view.T_world_sensor.linear() *
            view.camera.ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
        const double to_side = (distance_m - eye.x()) / ray.x();
        const double to_top = (height_m - eye.z()) / ray.z();
        const double to_floor = -eye.z() / ray.z();
        double depth = ray.z() < 0 ? to_floor : 0;
        if ((eye + to_side * ray).z() <= height_m)
          depth = ray.z() < 0 ? std::min(to_side, to_floor) : to_side;
        else if (ray.z() < 0 && (eye + to_top * ray).x() <= distance_m + length_m)
          depth = to_top;
        const std::size_t i = image.row_begin(v) + static_cast<std::size_t>(u);
        image.inverse_depth[i] = depth > 0 ? static_cast<float>(1 / depth) + noise(random) : 0.0F;
        image.certainty[i] = 1.0F / kSigma_per_m;
      }
    return image;
  }
  [[nodiscard]] Surfel side() const {
    return {.centroid_m = {distance_m, 0, 0.5 * height_m}, .normal = {-1, 0, 0}, .radius_m = 0.15F};
  }
  /// As one cell of it tells, when points up to `too_high_m` above the edge pass for points of the side.
  [[nodiscard]] std::optional<float> found(const SensorView& view, const MeasuredImage& image, double y_m,
                                           double too_high_m) const {
    const double top_m = height_m + too_high_m;
    std::vector<EndPixel> pixels;
    return side_end_z_m(side(), {{distance_m + 0.01, y_m}, 0.05, static_cast<float>(top_m), 0.03F}, image,
                        view, pixels);
  }
};

class SideEndTest : public testing::TestWithParam<double> {
 protected:
  SensorView view{kinect_frame(), Pose::Identity()};
  Scene scene{.distance_m = GetParam()};
};

TEST_P(SideEndTest, IsTheEdgeOfTheTopWhateverPassedForASidesPoint) {
  const MeasuredImage image = scene.seen(view, 1, 0.0F);
  for (const double too_high_m : {0.0, 0.005, 0.015, 0.02}) {
    const auto end = scene.found(view, image, 0.0, too_high_m);
    ASSERT_TRUE(end);
    EXPECT_NEAR(*end, scene.height_m, 0.001) << too_high_m;
  }
}

TEST_P(SideEndTest, HasNoBiasUnderNoise) {
  double sum_m = 0, square_m2 = 0;
  int cells = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const MeasuredImage image = scene.seen(view, seed, kSigma_per_m);
    for (double y_m = -0.7; y_m <= 0.7; y_m += 0.05, ++cells) {
      const double off_m =
          static_cast<double>(scene.found(view, image, y_m, 0.012).value_or(0.0F)) - scene.height_m;
      sum_m += off_m;
      square_m2 += off_m * off_m;
    }
  }
  EXPECT_NEAR(sum_m / cells, 0.0, 0.001);
  EXPECT_LT(std::sqrt(square_m2 / cells), 0.003);
}

/// Behind a wall's upper end there is nothing near: between its last row and the next nothing tells.
TEST_P(SideEndTest, IsWithinARowOfTheEndOfAWall) {
  scene.length_m = 0.0;
  const double row_m = 1.1 * scene.distance_m / 575.0;
  const MeasuredImage image = scene.seen(view, 1, 0.0F);
  const auto end = scene.found(view, image, 0.0, 0.01);
  ASSERT_TRUE(end);
  EXPECT_NEAR(*end, scene.height_m, 0.5 * row_m + 0.001);
}

/// Over many heights between two rows, with noise on the last of them.
TEST_P(SideEndTest, OfAWallIsWithinAThirdOfARowInTheMean) {
  scene.length_m = 0.0;
  const double row_m = 1.1 * scene.distance_m / 575.0;
  double sum_m = 0;
  int cells = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    scene.height_m = 0.2 + 0.25 * seed * row_m;
    const MeasuredImage image = scene.seen(view, seed + 1, kSigma_per_m);
    for (double y_m = -0.5; y_m <= 0.5; y_m += 0.05, ++cells)
      sum_m += static_cast<double>(scene.found(view, image, y_m, 0.0).value_or(0.0F)) - scene.height_m;
  }
  EXPECT_NEAR(sum_m / cells, 0.0, 0.3 * row_m);
}

INSTANTIATE_TEST_SUITE_P(Distances, SideEndTest, testing::Values(1.6, 2.5, 3.3, 4.0, 4.7, 5.3));

TEST(SideEnd, IsNothingAboveTheSensorOutsideTheImageOrOnASlope) {
  const SensorView view(kinect_frame(), Pose::Identity());
  const MeasuredImage image = Scene{}.seen(view, 1, 0.0F);
  EXPECT_FALSE((Scene{.height_m = 0.75}.found(view, image, 0.0, 0.0)));
  EXPECT_FALSE((Scene{}.found(view, image, 9.0, 0.0)));
  std::vector<EndPixel> pixels;
  const Surfel slope{.centroid_m = {4.0, 0, 0.1}, .normal = Eigen::Vector3f(-1, 0, 1).normalized()};
  EXPECT_FALSE(side_end_z_m(slope, {{4.0, 0.0}, 0.05, 0.2F, 0.03F}, image, view, pixels));
}

}  // namespace
}  // namespace floornav
