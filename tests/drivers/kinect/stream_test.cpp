#include <cmath>

#include <OpenNI.h>
#include <gtest/gtest.h>

#include "lcmtypes/depth_cloud.hpp"
#include "tests/drivers/kinect/driver_rig.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

std::vector<std::uint16_t> pixels_of(const depth_cloud_t& cloud) {
  std::vector<std::uint16_t> pixels;
  unpack_pixels(cloud, pixels);
  return pixels;
}

/// Largest difference of a cloud's depths from the room's, m, over the pixels without the room's noise.
double worst_error_m(const depth_cloud_t& cloud, const RoomScene& room, int skip = 1) {
  const std::vector<std::uint16_t> pixels = pixels_of(cloud);
  double worst = 0;
  for (int row = 0; row < cloud.height; ++row)
    for (int column = 1; column < cloud.width; ++column) {
      if ((row * skip * room.camera.width + column * skip) % 16 == 0) continue;
      const double depth =
          pixels[static_cast<std::size_t>(row * cloud.width + column)] * static_cast<double>(cloud.scale);
      worst = std::max(worst, std::abs(depth - room.depth_at(column * skip, row * skip)));
    }
  return worst;
}

TEST(KinectStream, PublishesTheRoomAsItIs) {
  const RoomScene room;
  DriverRig rig(room);
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(10));
  const depth_cloud_t cloud = rig.bus.clouds().back().message;
  EXPECT_LT(worst_error_m(cloud, room), 0.00056);
  EXPECT_EQ(cloud.source, "kinect");
  EXPECT_EQ(cloud.width, 640);
  EXPECT_EQ(cloud.rows, 480);
  EXPECT_NEAR(cloud.fx, 575.8F, 0.1F);
  EXPECT_NEAR(cloud.cx, 319.5F, 1e-3F);
  EXPECT_NEAR(cloud.disparity_sigma, 0.014F / 9 * 575.8F * 0.075F, 1e-4F);
}

TEST(KinectStream, NumbersFramesWithoutGaps) {
  DriverRig rig;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(30));
  const auto clouds = rig.bus.clouds();
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(clouds[i].message.frame, static_cast<std::int64_t>(i) + 1);
    EXPECT_EQ(clouds[i].message.seq, static_cast<std::int64_t>(i) + 1);
  }
}

TEST(KinectStream, UndoesAMirrorThatTheDeviceInsistsOn) {
  const RoomScene room;
  DriverRig rig(room);
  rig.kinect()->only_mirrored = 1;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(3));
  EXPECT_LT(worst_error_m(rig.bus.clouds().back().message, room), 0.00056);
}

TEST(KinectStream, OffersTenthsOfAMillimetre) {
  const RoomScene room;
  DriverRig rig(room);
  rig.settings.depth_unit_um = 100;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(3));
  EXPECT_LT(worst_error_m(rig.bus.clouds().back().message, room), 0.000051);
}

TEST(KinectStream, OffersAQuarterOfThePixels) {
  const RoomScene room;
  DriverRig rig(room);
  rig.settings.width = 320;
  rig.settings.height = 240;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(3));
  const depth_cloud_t cloud = rig.bus.clouds().back().message;
  EXPECT_EQ(cloud.width, 320);
  EXPECT_NEAR(cloud.fx, 575.8F / 2, 0.1F);
  EXPECT_LT(worst_error_m(cloud, room, 2), 0.00056);
}

TEST(KinectStream, SaysWhatIsOfferedWhereAModeIsNot) {
  DriverRig rig;
  rig.settings.frames_per_second = 60;
  rig.start();
  ASSERT_TRUE(rig.wait_for_state(health_t::FAULT, "640x480 at 30 Hz, 1 mm"));
}

TEST(KinectStream, OpensTheOneThatIsAskedFor) {
  for (const char* asked : {"virtual-kinect://1", "VK0001"}) {
    DriverRig rig;
    rig.kinect()->devices = 1;
    rig.settings.device = asked;
    rig.start();
    ASSERT_TRUE(rig.wait_for_clouds(2)) << asked;
    EXPECT_NE(rig.lines().back().find("virtual-kinect://1"), std::string::npos) << rig.lines().back();
  }
}

TEST(KinectStream, SaysWhichThereAreWhereTheOneAskedForIsNot) {
  DriverRig rig;
  rig.settings.device = "A00362";
  rig.start();
  ASSERT_TRUE(rig.wait_for_state(health_t::FAULT, "there is virtual-kinect://0"));
}

/// OpenNI2's own conversion, to the half pixel by which it sets the image's centre differently.
TEST(KinectStream, HasTheRaysOfOpenNisCoordinateConverter) {
  const RoomScene room;
  DriverRig rig(room);
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(1));
  const depth_cloud_t cloud = rig.bus.clouds().back().message;
  rig.stop();
  openni::OpenNI::initialize();
  {
    openni::Device device;
    openni::VideoStream stream;
    ASSERT_EQ(device.open(openni::ANY_DEVICE), openni::STATUS_OK);
    ASSERT_EQ(stream.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
    for (const int row : {0, 100, 479})
      for (const int column : {0, 333, 639}) {
        float x = 0;
        float y = 0;
        float z = 0;
        openni::CoordinateConverter::convertDepthToWorld(stream, column, row, openni::DepthPixel{1000}, &x,
                                                         &y, &z);
        const Pinhole camera{cloud.fx, cloud.fy, cloud.cx, cloud.cy, cloud.width, cloud.height};
        const Eigen::Vector3f ray = camera.ray(static_cast<float>(column), static_cast<float>(row)) * 1000;
        EXPECT_NEAR(ray.x(), x, 0.51F / 575.8F * 1000);
        EXPECT_NEAR(ray.y(), -y, 0.51F / 575.8F * 1000);  // OpenNI2's y is up
      }
  }
  openni::OpenNI::shutdown();
}

}  // namespace
}  // namespace floornav
