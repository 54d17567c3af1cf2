#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "drivers/camera/connection.hpp"
#include "drivers/camera/mounting.hpp"
#include "drivers/kinect/device_frame.hpp"
#include "drivers/kinect/field_of_view.hpp"
#include "drivers/kinect/lens.hpp"

namespace floornav {
namespace {

TEST(FieldOfView, SpansTheImagesOuterEdges) {
  const Pinhole camera = pinhole_of_field_of_view(1.0145, 0.7898, 640, 480);
  const auto angle = [](float edge, float center, float focal) {
    return std::atan(static_cast<double>((edge - center) / focal));
  };
  EXPECT_NEAR(angle(639.5F, camera.cx, camera.fx) - angle(-0.5F, camera.cx, camera.fx), 1.0145, 1e-6);
  EXPECT_NEAR(angle(479.5F, camera.cy, camera.fy) - angle(-0.5F, camera.cy, camera.fy), 0.7898, 1e-6);
}

TEST(FieldOfView, RefusesAnglesThatNoPinholeHas) {
  for (const double bad : {0.0, -1.0, 3.2, std::nan("")})
    EXPECT_THROW(pinhole_of_field_of_view(bad, 0.8, 640, 480), std::invalid_argument) << bad;
}

TEST(Mounting, LooksDownToTheRightAndLeftAsItSays) {
  MountingSettings mounting;
  mounting.x_m = 0.2;
  mounting.height_m = 0.7;
  mounting.pitch_deg = 30;
  const Pose down = sensor_in_body(mounting);
  EXPECT_TRUE(
      (down * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(0.2 + std::sqrt(0.75), 0, 0.2), 1e-9));
  EXPECT_TRUE((down * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0.2, -1, 0.7), 1e-9));
  mounting.pitch_deg = 0;
  mounting.yaw_deg = 90;
  EXPECT_TRUE(
      (sensor_in_body(mounting) * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(0.2, 1, 0.7), 1e-9));
  mounting.yaw_deg = 0;
  mounting.roll_deg = 90;  // its right side hangs down
  EXPECT_TRUE(
      (sensor_in_body(mounting) * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0.2, 0, -0.3), 1e-9));
}

struct Image {
  std::vector<std::uint8_t> bytes;
  DeviceFrame frame;

  /// Depth of pixel (column, row) is 100 row + column + 1; rows lie `stride` bytes apart.
  Image(int width, int height, int stride) : bytes(static_cast<std::size_t>(stride * height), 0xEE) {
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const auto depth = static_cast<std::uint16_t>(100 * row + column + 1);
        std::memcpy(&bytes[static_cast<std::size_t>(row * stride + 2 * column)], &depth, 2);
      }
    frame = {bytes.data(), bytes.size(), width, height, stride, 1, 0};
  }
};

TEST(DeviceFrame, RowsOfAnyStrideBecomeOneImageTheRightWayRound) {
  for (const int stride : {10, 11, 24})
    for (const bool mirrored : {false, true}) {
      const Image image(5, 4, stride);
      std::vector<std::uint16_t> pixels;
      ASSERT_EQ(copy_depths(image.frame, {5, 4, mirrored, 10'000}, pixels), FrameFlaw::kNone);
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column)
          EXPECT_EQ(pixels[static_cast<std::size_t>(5 * row + column)],
                    100 * row + (mirrored ? 4 - column : column) + 1);
    }
}

TEST(DeviceFrame, LastRowNeedsNoPadding) {
  Image image(5, 4, 24);
  image.frame.size = 3 * 24 + 10;
  std::vector<std::uint16_t> pixels;
  EXPECT_EQ(copy_depths(image.frame, {5, 4, false, 10'000}, pixels), FrameFlaw::kNone);
  image.frame.size -= 1;
  EXPECT_EQ(copy_depths(image.frame, {5, 4, false, 10'000}, pixels), FrameFlaw::kCutShort);
}

TEST(DeviceFrame, NothingThatAFrameSaysOfItselfIsBelieved) {
  const Image image(5, 4, 10);
  std::vector<std::uint16_t> pixels;
  const auto flaw_of = [&](auto change) {
    DeviceFrame frame = image.frame;
    change(frame);
    return copy_depths(frame, {5, 4, false, 10'000}, pixels);
  };
  EXPECT_EQ(flaw_of([](DeviceFrame& f) { f.width = 6; }), FrameFlaw::kWrongSize);
  EXPECT_EQ(flaw_of([](DeviceFrame& f) { f.height = 1'000'000; }), FrameFlaw::kWrongSize);
  EXPECT_EQ(flaw_of([](DeviceFrame& f) { f.width = -5; }), FrameFlaw::kWrongSize);
  EXPECT_EQ(flaw_of([](DeviceFrame& f) { f.stride = 9; }), FrameFlaw::kCutShort);
  EXPECT_EQ(flaw_of([](DeviceFrame& f) { f.stride = -10; }), FrameFlaw::kCutShort);
  EXPECT_EQ(flaw_of([](DeviceFrame& f) { f.size = 0; }), FrameFlaw::kCutShort);
}

TEST(DeviceFrame, ImpossibleDepthsMeasureNothingAndManyOfThemAreGarbage) {
  const Image image(20, 20, 40);  // depths 1 .. 1920
  std::vector<std::uint16_t> pixels;
  EXPECT_EQ(copy_depths(image.frame, {20, 20, false, 1918}, pixels), FrameFlaw::kNone);
  EXPECT_EQ(pixels[399], 0);
  EXPECT_EQ(pixels[397], 1918);
  EXPECT_EQ(copy_depths(image.frame, {20, 20, false, 1910}, pixels), FrameFlaw::kGarbage);
}

TEST(Lens, WithoutDistortionNothingChanges) {
  const Pinhole camera{60, 60, 39.5F, 29.5F, 80, 60};
  Lens lens(camera, {});
  std::vector<std::uint16_t> pixels(80 * 60);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint16_t>(i);
  std::vector<std::uint16_t> same = pixels;
  lens.undistort(same);
  EXPECT_EQ(same, pixels);
}

/// A plane seen through a distorting lens is a plane again, to the rounding to the nearest pixel.
TEST(Lens, APlaneIsFlatAgain) {
  const Pinhole camera{575, 575, 319.5F, 239.5F, 640, 480};
  const Distortion distortion = {-0.25, 0.12, 0.002, -0.001, 0.0};
  const auto depth_on_plane = [](const Eigen::Vector2d& ray) {
    return 2000 / (1 + 0.3 * ray.x() + 0.5 * ray.y());
  };
  // What the real camera sees: for each of its pixels the ray whose distorted place is that pixel, by
  // iteration.
  std::vector<std::uint16_t> pixels;
  for (int row = 0; row < camera.height; ++row)
    for (int column = 0; column < camera.width; ++column) {
      const Eigen::Vector2d seen =
          camera.ray(static_cast<float>(column), static_cast<float>(row)).head<2>().cast<double>();
      Eigen::Vector2d ray = seen;
      for (int i = 0; i < 20; ++i) ray += seen - distort(ray, distortion);
      pixels.push_back(static_cast<std::uint16_t>(std::lround(depth_on_plane(ray))));
    }
  double before = 0;
  double after = 0;
  std::vector<std::uint16_t> flat = pixels;
  Lens(camera, distortion).undistort(flat);
  for (int row = 0; row < camera.height; ++row)
    for (int column = 0; column < camera.width; ++column) {
      const auto at = static_cast<std::size_t>(row * camera.width + column);
      const Eigen::Vector2d ray =
          camera.ray(static_cast<float>(column), static_cast<float>(row)).head<2>().cast<double>();
      before = std::max(before, std::abs(pixels[at] - depth_on_plane(ray)));
      if (flat[at] != 0) after = std::max(after, std::abs(flat[at] - depth_on_plane(ray)));
    }
  EXPECT_GT(before, 30);
  EXPECT_LT(after, 5);
}

class ConnectionTest : public testing::Test {
 protected:
  using Action = Connection::Action;
  Connection connection{{500'000, 2'000'000, 1'000'000}};
};

TEST_F(ConnectionTest, OpensWhatIsListed) {
  EXPECT_EQ(connection.next(5, true), Action::kOpen);
}

TEST_F(ConnectionTest, LooksAnewOnceAPeriodForWhatIsNot) {
  std::vector<std::int64_t> restarts;
  for (std::int64_t now = 10'000'000; now < 14'000'000; now += 20'000)
    if (connection.next(now, false) == Action::kRestart) restarts.push_back(now);
  EXPECT_EQ(restarts, (std::vector<std::int64_t>{10'000'000, 11'000'000, 12'000'000, 13'000'000}));
}

TEST_F(ConnectionTest, GivesUpASilentDeviceAndOpensItWithAFreshLibrary) {
  connection.opened(0);
  connection.frame(100'000);
  EXPECT_EQ(connection.next(599'999, true), Action::kNothing);
  EXPECT_EQ(connection.next(600'000, true), Action::kClose);
  EXPECT_EQ(connection.next(600'001, true), Action::kRestart);
  EXPECT_EQ(connection.next(600'002, true), Action::kOpen);
}

TEST_F(ConnectionTest, HasMorePatienceBeforeTheFirstFrame) {
  connection.opened(0);
  EXPECT_EQ(connection.next(1'999'999, true), Action::kNothing);
  EXPECT_EQ(connection.next(2'000'000, true), Action::kClose);
}

TEST_F(ConnectionTest, WaitsForADeviceWhoseLibraryTellsWhenItComesBack) {
  connection.opened(0);
  connection.frame(100'000);
  connection.gone();
  EXPECT_EQ(connection.next(110'000, false), Action::kClose);
  for (std::int64_t now = 120'000; now < 60'000'000; now += 20'000)
    ASSERT_EQ(connection.next(now, false), Action::kNothing);
  EXPECT_EQ(connection.next(60'000'000, true), Action::kOpen);
}

TEST_F(ConnectionTest, AFailedAttemptIsRepeatedOnceAPeriodWithAFreshLibrary) {
  EXPECT_EQ(connection.next(0, true), Action::kOpen);
  connection.failed(0);
  EXPECT_EQ(connection.next(999'999, true), Action::kNothing);
  EXPECT_EQ(connection.next(1'000'000, true), Action::kRestart);
  EXPECT_EQ(connection.next(1'000'001, true), Action::kOpen);
}

}  // namespace
}  // namespace floornav
