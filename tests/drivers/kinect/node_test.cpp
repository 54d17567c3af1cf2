// The node with frames and a device's state put into its hands: no device, no thread, no waiting.
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/kinect/node/kinect_node.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "runtime/process/identity.hpp"

namespace floornav {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr std::int64_t kPeriod_us = 33'333;

struct FakeSource final : FrameSource<CapturedFrame> {
  bool take(CapturedFrame& frame) override {
    if (!has_frame) return false;
    has_frame = false;
    std::swap(frame, next);
    return true;
  }
  [[nodiscard]] CaptureStatus status() const override { return state; }
  void notify(std::function<void()>) override {}

  bool has_frame = false;
  CapturedFrame next;
  CaptureStatus state;
};

class KinectNodeTest : public testing::Test {
 protected:
  KinectNodeTest() { open(); }

  /// The device is opened (again).
  void open() {
    DepthStream opened;
    opened.device = "fake";
    opened.shape = {kWidth, kHeight, false, 10'000};
    opened.camera = {60, 60, 31.5F, 23.5F, kWidth, kHeight};
    opened.period_us = kPeriod_us;
    stream = std::make_shared<const DepthStream>(opened);
    source->state.trouble = "";
    source->state.opened += 1;
  }

  static std::vector<std::uint16_t> noise(unsigned seed) {
    std::minstd_rand random(seed);
    std::vector<std::uint16_t> pixels(kWidth * kHeight);
    for (auto& pixel : pixels) pixel = static_cast<std::uint16_t>(500 + random() % 3000);
    return pixels;
  }

  /// A frame of this number arrives on time; the messages that the node then sends.
  std::vector<depth_cloud_t> give(std::int64_t number, std::vector<std::uint16_t> pixels) {
    const std::int64_t exposure = number * kPeriod_us;
    source->next.stream = stream;
    source->next.pixels = std::move(pixels);
    source->next.number = number;
    source->next.dropped_before = dropped_before;
    source->next.stamp = static_cast<std::uint64_t>(exposure);
    source->next.arrival = {exposure + 33'000, exposure + 33'000 + wall_us};
    source->has_frame = true;
    now = Micros(source->next.arrival.monotonic_us);
    UnlimitedBudget budget;
    node.step(now, budget, out);
    std::vector<depth_cloud_t> clouds;
    for (const EncodedMessage& message : out.take()) {
      clouds.emplace_back();
      const int size = static_cast<int>(message.bytes.size());
      EXPECT_EQ(clouds.back().decode(message.bytes.data(), 0, size), size);
    }
    return clouds;
  }
  std::vector<depth_cloud_t> give(std::int64_t number) {
    return give(number, noise(static_cast<unsigned>(number + 1)));
  }

  health_t health() {
    health_t report{};
    report.state = health_t::OK;
    node.report(report);
    return report;
  }
  std::int64_t drops(const std::string& cause) {
    for (const drop_t& drop : health().drops)
      if (drop.cause == cause) return drop.count;
    return 0;
  }

  int given_up = 0;
  FakeSource* source = new FakeSource;  // the node's
  KinectNode node{KinectSettings{}, std::unique_ptr<FrameSource<CapturedFrame>>(source),
                  [this] { ++given_up; }};
  Outbox out{fixed_identity("kinect")};
  std::shared_ptr<const DepthStream> stream;
  std::int64_t wall_us = 1'700'000'000'000'000;
  std::int64_t dropped_before = 0;
  Micros now{0};
};

TEST_F(KinectNodeTest, AFrameBecomesACloudThatPassesEveryCheckOfTheWire) {
  const std::vector<std::uint16_t> pixels = noise(7);
  const auto clouds = give(100, pixels);
  ASSERT_EQ(clouds.size(), 1U);
  std::vector<std::uint16_t> decoded;
  unpack_pixels(clouds[0], decoded);
  EXPECT_EQ(decoded, pixels);
  EXPECT_EQ(clouds[0].utime, 100 * kPeriod_us + wall_us);
  EXPECT_EQ(clouds[0].sensor, depth_cloud_t::KINECT);
  EXPECT_EQ(clouds[0].frame, 1);
}

TEST_F(KinectNodeTest, FrameNumbersJumpOverWhatTheDeviceLost) {
  EXPECT_EQ(give(10)[0].frame, 1);
  EXPECT_EQ(give(11)[0].frame, 2);
  EXPECT_EQ(give(15)[0].frame, 6);
  EXPECT_EQ(drops("frame lost by the device"), 3);
  EXPECT_EQ(health().state, health_t::DEGRADED);
}

TEST_F(KinectNodeTest, WhatTheDriverDroppedItselfIsNotBlamedOnTheDevice) {
  give(10);
  dropped_before = 3;
  EXPECT_EQ(give(14)[0].frame, 5);
  EXPECT_EQ(drops("frame lost by the device"), 0);
  EXPECT_EQ(health().state, health_t::OK);
  EXPECT_EQ(give(19)[0].frame, 10);
  EXPECT_EQ(drops("frame lost by the device"), 1);
}

TEST_F(KinectNodeTest, FrameNumbersGoOnWhereTheDeviceIsOpenedAnew) {
  give(500);
  give(501);
  open();
  EXPECT_EQ(give(1)[0].frame, 3);
  EXPECT_EQ(drops("frame lost by the device"), 0);
  EXPECT_EQ(drops("device opened anew"), 1);
}

TEST_F(KinectNodeTest, TheFifthEqualImageIsWithheldUntilItChanges) {
  for (int number = 0; number < 4; ++number) EXPECT_EQ(give(number, noise(3)).size(), 1U);
  EXPECT_EQ(give(4, noise(3)).size(), 0U);
  EXPECT_EQ(give(5, noise(3)).size(), 0U);
  EXPECT_EQ(health().state, health_t::FAULT);
  EXPECT_EQ(drops("frame stuck"), 2);
  EXPECT_EQ(give(6, noise(4)).size(), 1U);
  EXPECT_EQ(health().state, health_t::OK);
}

TEST_F(KinectNodeTest, NothingSeenIsPublishedAndTold) {
  EXPECT_EQ(give(0, std::vector<std::uint16_t>(kWidth * kHeight, 0)).size(), 1U);
  EXPECT_EQ(health().state, health_t::DEGRADED);
  EXPECT_EQ(give(1).size(), 1U);
  EXPECT_EQ(health().state, health_t::OK);
}

TEST_F(KinectNodeTest, AWallClockThatStepsStepsTheNextUtimeAndNothingElse) {
  give(0);
  wall_us += 3'600'000'000;
  const auto clouds = give(1);
  EXPECT_EQ(clouds[0].utime, kPeriod_us + wall_us);
  EXPECT_EQ(clouds[0].frame, 2);
  EXPECT_EQ(health().state, health_t::OK);
}

TEST_F(KinectNodeTest, ADeviceThatIsGoneIsAFault) {
  give(0);
  source->state.trouble = "the device is gone";
  EXPECT_EQ(health().state, health_t::FAULT);
  EXPECT_EQ(health().reason, "the device is gone");
}

TEST_F(KinectNodeTest, ALibraryThatHangsIsToldAndGivenUpOnce) {
  source->state.doing = "opening the device";
  source->state.doing_us = 2'100'000;
  node.tick(now, out);
  EXPECT_EQ(health().state, health_t::FAULT);
  EXPECT_NE(health().reason.find("opening the device"), std::string::npos);
  EXPECT_EQ(given_up, 0);
  source->state.doing_us = 10'100'000;
  node.tick(now, out);
  node.tick(now, out);
  EXPECT_EQ(given_up, 1);
}

}  // namespace
}  // namespace floornav
