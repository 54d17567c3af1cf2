#include <algorithm>
#include <cmath>

#include <OpenNI.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "lcmtypes/depth_cloud.hpp"
#include "tests/drivers/kinect/driver_rig.hpp"

namespace floornav {
namespace {

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

TEST(KinectStream, NumbersFramesByTheirExposures) {
  DriverRig rig;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(30));
  const auto clouds = rig.bus.clouds();
  EXPECT_EQ(clouds.front().message.frame, 1);
  expect_frames_count_exposures(clouds, RoomScene().period_us);
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

/// The virtual colour camera stands where the depth camera does and has a focal length of 525 px.
TEST(KinectStream, RegisteredDepthIsWhatTheColourCameraSees) {
  RoomScene seen_by_color;
  seen_by_color.camera.fx = seen_by_color.camera.fy = 525;
  DriverRig rig;
  rig.settings.registration = true;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(3));
  const depth_cloud_t cloud = rig.bus.clouds().back().message;
  EXPECT_NEAR(cloud.fx, 525, 0.1F);
  std::vector<std::uint16_t> pixels;
  unpack_pixels(cloud, pixels);
  int measured = 0;
  for (int row = 0; row < 480; ++row)
    for (int column = 200; column < 640; ++column) {
      const double depth = pixels[static_cast<std::size_t>(row * 640 + column)] * 1e-3;
      if (depth == 0) continue;
      ++measured;
      EXPECT_NEAR(depth, seen_by_color.depth_at(column, row),
                  0.03);  // half a pixel where the floor meets the wall
    }
  EXPECT_GT(measured, 160'000);
}

TEST(KinectStream, SaysWhatIsOfferedWhereAModeIsNot) {
  DriverRig rig;
  rig.settings.frames_per_second = 60;
  rig.start();
  ASSERT_TRUE(rig.wait_for_state(health_t::FAULT, "640x480 at 30 Hz, 1 mm"));
}

/// The virtual Kinect paints its row in green and its column in blue (modulo 256).
TEST(KinectStream, SendsColourWhereItIsAskedFor) {
  for (const int only_mirrored : {0, 1}) {
    DriverRig rig;
    rig.kinect()->only_mirrored = only_mirrored;
    rig.settings.color = true;
    rig.start();
    ASSERT_TRUE(rig.wait_for_clouds(10));
    rig.stop();
    const std::vector<image_t> images = rig.bus.images();
    ASSERT_GE(images.size(), 5U);
    const image_t& image = images.back();
    EXPECT_EQ(image.pixelformat, image_t::PIXEL_FORMAT_MJPEG);
    const cv::Mat bgr = cv::imdecode(image.data, cv::IMREAD_COLOR);
    ASSERT_EQ(bgr.cols, 640);
    ASSERT_EQ(bgr.rows, 480);
    EXPECT_NEAR(bgr.at<cv::Vec3b>(200, 100)[1], 200, 12);
    EXPECT_NEAR(bgr.at<cv::Vec3b>(200, 100)[0], 100, 12);
    const auto clouds = rig.bus.clouds();
    EXPECT_TRUE(std::any_of(clouds.begin(), clouds.end(), [&](const auto& cloud) {
      return std::abs(image.utime - cloud.message.utime) < 70'000;
    }));
  }
}

TEST(KinectStream, SendsNoColourOtherwise) {
  DriverRig rig;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(5));
  EXPECT_TRUE(rig.bus.images().empty());
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

TEST(KinectStream, PlaysARecordingOverAndOver) {
  const RoomScene room;
  DriverRig rig(room);
  const TemporaryFolder folder;
  rig.settings.device = (folder / "room.oni").string();
  {
    OpenNiDevice device(KinectSettings{}, {Playback::kInRealTime, rig.settings.device});
    device.open();
    for (int frames = 0; frames < 12;)
      frames += device.wait(std::chrono::seconds(1)) == DepthDevice::Event::kFrame ? 1 : 0;
  }
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(40));
  for (const auto& cloud : rig.bus.clouds()) ASSERT_LT(worst_error_m(cloud.message, room), 0.00056);
  EXPECT_EQ(rig.status().opened, 1);
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
