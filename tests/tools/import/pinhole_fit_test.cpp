#include "tools/import/pinhole_fit.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/real_data.hpp"

namespace floornav {
namespace {

/// A cloud on a camera's rays, at random depths in whole units.
OrganisedCloud cloud_on_rays(const Pinhole& camera, double unit_m, double farthest_m) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> units(1, static_cast<int>(farthest_m / unit_m));
  OrganisedCloud cloud{camera.width, camera.height, {}};
  for (int row = 0; row < camera.height; ++row)
    for (int column = 0; column < camera.width; ++column) {
      const auto z = static_cast<float>(units(random) * unit_m);
      cloud.points.emplace_back(z * camera.ray(static_cast<float>(column), static_cast<float>(row)));
    }
  return cloud;
}

const Pinhole kCamera{100.0F, 110.0F, 31.0F, 23.5F, 64, 48};

TEST(PinholeFit, FindsTheCameraOfACloud) {
  const OrganisedCloud cloud = cloud_on_rays(kCamera, 0.001, 6);
  const Pinhole found = fit_pinhole(cloud);
  EXPECT_NEAR(found.fx, kCamera.fx, 1e-3);
  EXPECT_NEAR(found.fy, kCamera.fy, 1e-3);
  EXPECT_NEAR(found.cx, kCamera.cx, 1e-3);
  EXPECT_NEAR(found.cy, kCamera.cy, 1e-3);
  EXPECT_LT(ray_residual(cloud, found).worst_px, 1e-3);
}

TEST(PinholeFit, TellsHowFarOffAnotherCameraIs) {
  Pinhole shifted = kCamera;
  shifted.cx += 3;
  shifted.cy += 4;
  EXPECT_NEAR(ray_residual(cloud_on_rays(kCamera, 0.001, 6), shifted).rms_px, 5, 1e-3);
}

TEST(PinholeFit, NeedsPointsInFrontOfTheCamera) {
  OrganisedCloud cloud = cloud_on_rays(kCamera, 0.001, 6);
  for (auto& point : cloud.points) point = -point;
  EXPECT_THROW(fit_pinhole(cloud), std::runtime_error);
}

TEST(DepthOfACloud, IsExactInMillimetresWhereTheCloudIs) {
  const OrganisedCloud cloud = cloud_on_rays(kCamera, 0.001, 8);
  const ScaledDepth depth = depth_of(cloud);
  EXPECT_EQ(depth.scale_m, 0.001);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    ASSERT_EQ(depth.image.pixels[i], std::lround(cloud.points[i].z() * 1000));
}

TEST(DepthOfACloud, IsAsFineAsSixteenBitsReachElsewhere) {
  EXPECT_EQ(depth_of(cloud_on_rays(kCamera, 0.00013, 6)).scale_m, 0.0001);
  const ScaledDepth far = depth_of(cloud_on_rays(kCamera, 0.00013, 12));
  EXPECT_EQ(far.scale_m, 0.0002);
  EXPECT_LE(far.worst_rounding_m, 0.0001 + 1e-6);
}

/// The same three frames exist as clouds and as the depth images that the clouds were made from.
TEST(DepthOfACloud, EqualsTheDepthImageThatARealCloudWasMadeFrom) {
  const auto folder = real_data("pcl_clouds") / "grabber_sequences";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "pcd")) {
    if (entry.path().extension() != ".pcd") continue;
    const auto image = folder / "tiff" / (entry.path().stem().string() + "_depth.tiff");
    EXPECT_EQ(depth_of(read_pcd(entry.path())).image.pixels, read_depth_image(image).pixels) << entry.path();
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

}  // namespace
}  // namespace floornav
