#include <bit>
#include <cmath>

#include <gtest/gtest.h>
#include <zlib.h>

#include "floornav/goal_t.hpp"
#include "kinect/frame_msg_t.hpp"
#include "runtime/process/log_writer.hpp"
#include "tests/tools/import/recorded.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/import/import.hpp"
#include "tools/import/kinect_frame.hpp"

namespace floornav {
namespace {

using kinect::depth_msg_t;

constexpr std::int64_t kStart_us = 1'349'300'000'000'000;
const Pinhole kCamera{80.0F, 80.0F, 39.5F, 29.5F, 80, 60};

ImportTarget target(const std::filesystem::path& log) {
  return {log, imported_sensor("kinect"), [](auto, auto) {}};
}

/// 80 x 60 counts that count up from `first`.
kinect::frame_msg_t frame(std::int8_t format, std::int64_t utime_us, std::uint16_t first) {
  kinect::frame_msg_t message{};
  message.timestamp = message.depth.timestamp = utime_us;
  message.depth.width = 80;
  message.depth.height = 60;
  message.depth.depth_data_format = format;
  message.depth.compression = depth_msg_t::COMPRESSION_NONE;
  for (int i = 0; i < 80 * 60; ++i) {
    const int count = first + i % 500;
    message.depth.depth_data.push_back(static_cast<std::uint8_t>(count & 0xFF));
    message.depth.depth_data.push_back(static_cast<std::uint8_t>(count >> 8));
  }
  message.depth.uncompressed_size = static_cast<std::int32_t>(message.depth.depth_data.size());
  message.depth.depth_data_nbytes = message.depth.uncompressed_size;
  return message;
}

kinect::frame_msg_t compressed(kinect::frame_msg_t message) {
  uLongf size = ::compressBound(message.depth.depth_data.size());
  std::vector<std::uint8_t> bytes(size);
  EXPECT_EQ(::compress(bytes.data(), &size, message.depth.depth_data.data(), message.depth.depth_data.size()),
            Z_OK);
  bytes.resize(size);
  message.depth.depth_data = bytes;
  message.depth.depth_data_nbytes = static_cast<std::int32_t>(size);
  message.depth.compression = depth_msg_t::COMPRESSION_ZLIB;
  return message;
}

template <class Message>
void write(LogWriter& log, std::int64_t utime_us, const char* channel, const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  ASSERT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  log.write(utime_us, channel, bytes);
}

/// The fingerprints that lcm-gen gave the kinect-lcm drivers' own definitions.
TEST(KinectLcm, HasTheFingerprintOfTheOriginalTypes) {
  const std::uint64_t image = std::rotl(std::uint64_t{0x01fc0e88fea09363}, 1);
  const std::uint64_t depth = std::rotl(std::uint64_t{0x2006d888ce0bb5f6}, 1);
  EXPECT_EQ(static_cast<std::uint64_t>(depth_msg_t::getHash()), depth);
  EXPECT_EQ(static_cast<std::uint64_t>(kinect::frame_msg_t::getHash()),
            std::rotl(std::uint64_t{0x92191b3e928f7e79} + image + depth, 1));
}

TEST(KinectLcm, MillimetresAreTakenPlainAndCompressed) {
  const kinect::frame_msg_t plain = frame(depth_msg_t::DEPTH_MM, kStart_us, 1000);
  for (const kinect::frame_msg_t& message : {plain, compressed(plain)}) {
    const KinectDepth depth = depth_of(message.depth, 575.8);
    EXPECT_EQ(depth.scale_m, 0.001);
    ASSERT_EQ(depth.image.pixels.size(), 4800U);
    for (std::size_t i = 0; i < 4800; ++i) ASSERT_EQ(depth.image.pixels[i], 1000 + i % 500);
  }
}

TEST(KinectLcm, ShiftsBecomeDepthsAndThoseWithoutAMeasurementNone) {
  const KinectDepth depth = depth_of(frame(depth_msg_t::DEPTH_11BIT, kStart_us, 600).depth, 580);
  for (std::size_t i = 0; i < 500; ++i) {
    const double shift = 600 + static_cast<double>(i);
    const double expected = shift < 1090 ? 8 * 580 * 0.075 / (1090 - shift) : 1e9;
    const double read = depth.image.pixels[i] * depth.scale_m;
    if (expected > 10)
      EXPECT_EQ(read, 0) << shift;
    else
      EXPECT_NEAR(read, expected, 0.00011) << shift;
  }
  EXPECT_EQ(depth_of(frame(depth_msg_t::DEPTH_11BIT, kStart_us, 2047).depth, 580).image.pixels[0], 0);
}

TEST(KinectLcm, WhatIsWrongWithAFrameIsSaid) {
  const auto refused = [](auto change,
                          kinect::frame_msg_t message = frame(depth_msg_t::DEPTH_MM, kStart_us, 1000)) {
    change(message.depth);
    EXPECT_THROW(depth_of(message.depth, 580), std::runtime_error);
  };
  const kinect::frame_msg_t small = compressed(frame(depth_msg_t::DEPTH_MM, kStart_us, 1000));
  refused([](depth_msg_t& d) { d.depth_data_format = depth_msg_t::DEPTH_NONE; });
  refused([](depth_msg_t& d) { d.width = -80; });
  refused([](depth_msg_t& d) { d.width = 32000, d.height = 32000; });
  refused([](depth_msg_t& d) { d.depth_data.pop_back(); });
  refused([](depth_msg_t& d) { d.compression = 7; });
  refused([](depth_msg_t& d) { d.depth_data[10] ^= 0xFF; }, small);
  refused([](depth_msg_t& d) { d.depth_data.resize(20); }, small);
  refused([](depth_msg_t& d) { d.height = 59; }, small);  // inflates to more than it says
  refused([](depth_msg_t& d) { d.height = 61; }, small);  // to less
}

TEST(LcmImport, PlacesFramesWithoutPosesApart) {
  const TemporaryFolder folder;
  LogWriter log(folder / "in.lcm");
  for (int i = 0; i < 12; ++i)
    write(log, kStart_us + i * 33'333 + 5'000, "KINECT_FRAME",
          compressed(
              frame(depth_msg_t::DEPTH_MM, kStart_us + i * 33'333, static_cast<std::uint16_t>(1000 + i))));
  log.close();
  const ImportReport report =
      import_lcm({folder / "in.lcm", "KINECT_FRAME", kCamera, {}}, target(folder / "out.lcm"));
  EXPECT_EQ(report.clouds, 12);
  EXPECT_EQ(report.poses, 12);
  const auto clouds = recorded_clouds(folder / "out.lcm");
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(clouds[i].message.utime, kStart_us + static_cast<std::int64_t>(i) * 33'333);
    EXPECT_EQ(clouds[i].pixels[0], 1000 + i);
    EXPECT_NEAR(clouds[i].T_world_body.translation().x(), 10.0 * static_cast<double>(i % 10), 1e-9);
  }
}

TEST(LcmImport, TakesTheLogsOwnPosesInOrderOfTime) {
  const TemporaryFolder folder;
  LogWriter log(folder / "in.lcm");
  for (int i = 0; i < 20; ++i) {  // a frame reaches the log after poses that are younger than it
    pose_t pose{};
    pose.utime = kStart_us + i * 10'000;
    pose.pos[0] = 0.1 * i;
    pose.orientation[0] = 1;
    write(log, pose.utime, "POSE", pose);
    if (i % 3 == 2)
      write(log, pose.utime, "KINECT_FRAME", frame(depth_msg_t::DEPTH_MM, pose.utime - 15'000, 900));
  }
  log.close();
  const ImportReport report =
      import_lcm({folder / "in.lcm", "KINECT_FRAME", kCamera, {}}, target(folder / "out.lcm"));
  EXPECT_EQ(report.clouds, 6);
  EXPECT_EQ(report.poses, 20);
  LogReader out(folder / "out.lcm");
  LogEvent event;
  std::int64_t last = 0;
  while (out.next(event)) {
    EXPECT_GE(event.timestamp_us, last);
    last = event.timestamp_us;
  }
}

TEST(LcmImport, LeavesOutWhatCannotBeReadAndSaysSo) {
  const TemporaryFolder folder;
  LogWriter log(folder / "in.lcm");
  write(log, kStart_us, "KINECT_FRAME", frame(depth_msg_t::DEPTH_MM, kStart_us, 900));
  write(log, kStart_us + 1, "KINECT_FRAME", frame(depth_msg_t::DEPTH_10BIT, kStart_us + 1, 900));
  write(log, kStart_us + 2, "KINECT_FRAME", frame(depth_msg_t::DEPTH_MM, kStart_us - 5, 900));
  write(log, kStart_us + 3, "KINECT_FRAME", goal_t{});
  log.close();
  const ImportReport report =
      import_lcm({folder / "in.lcm", "KINECT_FRAME", kCamera, {}}, target(folder / "out.lcm"));
  EXPECT_EQ(report.clouds, 1);
  EXPECT_EQ(report.notes.size(), 3U);
}

TEST(LcmImport, ALogOfSomethingElseIsRefusedWithItsChannels) {
  const TemporaryFolder folder;
  LogWriter log(folder / "in.lcm");
  write(log, kStart_us, "LASER", goal_t{});
  log.close();
  try {
    import_lcm({folder / "in.lcm", "KINECT_FRAME", kCamera, {}}, target(folder / "out.lcm"));
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("LASER"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.lcm"));
}

}  // namespace
}  // namespace floornav
