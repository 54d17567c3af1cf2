// Recordings: one that the virtual Kinect makes, and a real one.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "drivers/kinect/device_frame.hpp"
#include "drivers/kinect/node/openni_device.hpp"
#include "tests/devices/kinect/room_scene.hpp"
#include "tests/devices/kinect/virtual_kinect.hpp"
#include "tests/real_data.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;
using Image = std::vector<std::uint16_t>;

struct Recording {
  DepthStream stream;
  std::vector<Image> images;  ///< the right way round
  std::vector<Image> raw;     ///< as they came
};

Recording play(const std::string& file) {
  KinectSettings settings;
  settings.device = file;
  OpenNiDevice device(settings, {Playback::kByHand, ""});
  Recording recording{device.open(), {}, {}};
  FrameShape as_it_comes = recording.stream.shape;
  as_it_comes.mirrored = false;
  for (DepthDevice::Event event; (event = device.wait(1s)) != DepthDevice::Event::kGone;) {
    if (event == DepthDevice::Event::kNothing) continue;
    recording.images.emplace_back();
    recording.raw.emplace_back();
    EXPECT_EQ(copy_depths(device.frame(), recording.stream.shape, recording.images.back()), FrameFlaw::kNone);
    EXPECT_EQ(copy_depths(device.frame(), as_it_comes, recording.raw.back()), FrameFlaw::kNone);
  }
  device.close();
  return recording;
}

class OniTest : public testing::Test {
 protected:
  ~OniTest() override { ::unsetenv(kControlVariable); }
  const TemporaryFolder folder;
};

TEST_F(OniTest, WhatIsRecordedPlaysBackToTheBit) {
  write_room_scene({}, folder / "room.scene");
  VirtualKinect kinect(folder / "control", folder / "room.scene");
  ::setenv(kControlVariable, kinect.control_file().c_str(), 1);
  const std::string file = (folder / "room.oni").string();
  std::vector<Image> seen;
  {
    OpenNiDevice device(KinectSettings{}, {Playback::kInRealTime, file});
    const DepthStream stream = device.open();
    while (seen.size() < 15) {
      if (device.wait(1s) != DepthDevice::Event::kFrame) continue;
      seen.emplace_back();
      ASSERT_EQ(copy_depths(device.frame(), stream.shape, seen.back()), FrameFlaw::kNone);
    }
    device.close();
  }
  const Recording recording = play(file);
  ASSERT_GE(recording.images.size(), seen.size());
  auto at = recording.images.begin();
  for (const Image& image : seen) {
    at = std::find(at, recording.images.end(), image);
    ASSERT_NE(at, recording.images.end())
        << "an image that was seen is not in the recording, or out of order";
  }
  EXPECT_NEAR(recording.stream.camera.fx, 575.8F, 0.1F);
}

TEST_F(OniTest, ARecordingGoesOnInAFileOfItsOwnAfterAReconnect) {
  write_room_scene({}, folder / "room.scene");
  VirtualKinect kinect(folder / "control", folder / "room.scene");
  ::setenv(kControlVariable, kinect.control_file().c_str(), 1);
  OpenNiDevice device(KinectSettings{}, {Playback::kInRealTime, (folder / "room.oni").string()});
  for (int i = 0; i < 2; ++i) {
    device.open();
    for (int frames = 0; frames < 3;) frames += device.wait(1s) == DepthDevice::Event::kFrame ? 1 : 0;
    device.close();
  }
  EXPECT_GE(play((folder / "room.oni").string()).images.size(), 3U);
  EXPECT_GE(play((folder / "room-2.oni").string()).images.size(), 3U);
}

/// github.com/3DJ/3DJ_Test: 12 frames of a real Kinect, mirrored.
TEST_F(OniTest, ARealRecordingIsTurnedTheRightWayRound) {
  const std::filesystem::path file = real_data("kinect_oni") / "test.oni";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const Recording recording = play(file.string());
  ASSERT_EQ(recording.images.size(), 12U);
  EXPECT_TRUE(recording.stream.shape.mirrored);
  EXPECT_EQ(recording.stream.shape.width, 640);
  EXPECT_NEAR(2 * std::atan(320 / recording.stream.camera.fx), 1.0145, 1e-3);
  EXPECT_NEAR(2 * std::atan(240 / recording.stream.camera.fy), 0.7898, 1e-3);
  for (std::size_t i = 0; i < recording.images.size(); ++i)
    for (std::size_t at = 0; at < recording.images[i].size(); ++at)
      ASSERT_EQ(recording.images[i][at], recording.raw[i][at / 640 * 640 + 639 - at % 640]);
}

TEST_F(OniTest, WhatIsNoRecordingIsRefused) {
  KinectSettings settings;
  settings.device = (folder / "nowhere.oni").string();
  OpenNiDevice device(settings);
  EXPECT_FALSE(device.listed());
  EXPECT_EQ(device.absence(), settings.device + ": no such file");
  EXPECT_THROW(device.open(), DeviceError);
}

}  // namespace
}  // namespace floornav
