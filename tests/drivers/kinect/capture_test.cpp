// The capture's thread against a device in the test's hands.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/kinect/node/kinect_capture.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

/// Gives a frame whenever it is asked, until told otherwise.
class FakeDevice final : public DepthDevice {
 public:
  std::atomic<bool>& gone;
  std::atomic<bool>& hangs;
  FakeDevice(std::atomic<bool>& is_gone, std::atomic<bool>& does_hang) : gone(is_gone), hangs(does_hang) {}

  bool listed() override { return !gone; }
  DepthStream open() override {
    if (gone) throw DeviceError("nothing there");
    DepthStream stream;
    stream.shape = {4, 2, false, 10'000};
    stream.camera = {4, 4, 1.5F, 0.5F, 4, 2};
    return stream;
  }
  Event wait(std::chrono::milliseconds) override {
    while (hangs) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(200us);
    return gone ? Event::kGone : Event::kFrame;
  }
  DeviceFrame frame() override {
    ++number_;
    for (std::size_t i = 0; i < 8; ++i) pixels_[i] = static_cast<std::uint16_t>(number_ % 10'000);
    return {reinterpret_cast<const std::uint8_t*>(pixels_), sizeof pixels_, 4, 2, 8, number_, 0};
  }
  HostTime arrival() override { return {number_, number_}; }
  void close() override {}
  void restart() override {}
  std::string absence() override { return "nobody"; }

 private:
  std::int64_t number_ = 0;
  std::uint16_t pixels_[8] = {};
};

class CaptureTest : public testing::Test {
 protected:
  std::unique_ptr<KinectCapture> make() {
    return std::make_unique<KinectCapture>(std::make_unique<FakeDevice>(gone, hangs),
                                           Connection::Periods{100'000, 100'000, 5'000},
                                           [](const std::string&) {});
  }
  static bool eventually(const std::function<bool()>& holds) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (!holds() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(1ms);
    return holds();
  }
  std::atomic<bool> gone = false;
  std::atomic<bool> hangs = false;
};

TEST_F(CaptureTest, HandsOverWholeFramesInOrderAndTellsOfThoseThatWaitedTooLong) {
  const auto capture = make();
  std::atomic<int> arrived = 0;
  capture->notify([&] { ++arrived; });
  CapturedFrame frame;
  std::int64_t last = 0;
  std::int64_t dropped = 0;
  for (int taken = 0; taken < 200;) {
    if (!capture->take(frame)) continue;
    if (++taken % 50 == 0) std::this_thread::sleep_for(20ms);
    ASSERT_EQ(frame.number, last + 1 + frame.dropped_before);
    last = frame.number;
    dropped += frame.dropped_before;
    for (const std::uint16_t pixel : frame.pixels) ASSERT_EQ(pixel, frame.number % 10'000);
  }
  EXPECT_GT(arrived, 0);
  EXPECT_GT(dropped, 0);
  EXPECT_GE(capture->status().drops["frame superseded"], dropped);
  capture->notify({});
}

TEST_F(CaptureTest, OpensAgainWhatWasGone) {
  const auto capture = make();
  for (int i = 1; i <= 5; ++i) {
    ASSERT_TRUE(eventually([&] { return capture->status().trouble.empty(); })) << i;
    EXPECT_EQ(capture->status().opened, i);
    gone = true;
    ASSERT_TRUE(eventually([&] { return !capture->status().trouble.empty(); })) << i;
    gone = false;
  }
}

TEST_F(CaptureTest, TellsWhatTheLibraryIsDoingWhileItHangs) {
  const auto capture = make();
  ASSERT_TRUE(eventually([&] { return capture->status().trouble.empty(); }));
  hangs = true;
  EXPECT_TRUE(eventually([&] { return capture->status().doing_us > 20'000; }));
  EXPECT_STREQ(capture->status().doing, "waiting for a frame");
  hangs = false;
}

}  // namespace
}  // namespace floornav
