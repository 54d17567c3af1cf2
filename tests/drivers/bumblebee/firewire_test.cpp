// The whole driver on libdc1394 and the virtual bus: what it captures, and what it does about each fault.
// Each fault's test prints what it measured; what drivers/bumblebee/README.md promises decides in the long
// form (FLOORNAV_LONG=1) only, on a machine that does nothing else.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "drivers/bumblebee/camera_registers.hpp"
#include "drivers/bumblebee/node/firewire_camera.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "tests/drivers/bumblebee/bumblebee_rig.hpp"
#include "tests/drivers/fault_timing.hpp"
#include "tests/drivers/reconnects.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// What a cloud shows against the exact scene.
struct Seen {
  double valid = 0;  ///< share of the image
  double bad = 0;    ///< share of the valid that is off by more than 1 px
};

Seen seen_by(const depth_cloud_t& cloud, const cv::Mat1f& truth) {
  std::vector<std::uint16_t> pixels;
  unpack_pixels(cloud, pixels);
  std::int64_t valid = 0;
  std::int64_t bad = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i] == 0) continue;
    ++valid;
    const double found = pixels[i] * static_cast<double>(cloud.scale);
    bad += std::abs(found - static_cast<double>(truth.ptr<float>()[i])) > 1 ? 1 : 0;
  }
  return {static_cast<double>(valid) / static_cast<double>(pixels.size()),
          static_cast<double>(bad) / static_cast<double>(std::max<std::int64_t>(1, valid))};
}

/// The exact disparities of the pair of eyes that a cloud is of.
cv::Mat1f truth_of(const BumblebeeRig& rig, const depth_cloud_t& cloud) {
  StereoRigSpec spec = rig.rig().spec();
  const double all_m = spec.eyes_m.back();
  spec.eyes_m = {0.0, static_cast<double>(cloud.baseline)};
  const int shrink = spec.ideal.width / cloud.width;
  spec.ideal = {
      cloud.fx, cloud.fy, cloud.cx, cloud.cy, spec.ideal.width / shrink, spec.ideal.height / shrink};
  return StereoRig(spec, 1).true_disparity(
      test_room(), test_mounting() * Eigen::Translation3d(all_m - static_cast<double>(cloud.baseline), 0, 0));
}

void expect_shows_the_room(const BumblebeeRig& rig, const depth_cloud_t& cloud) {
  const Seen seen = seen_by(cloud, truth_of(rig, cloud));
  fmt::print("[ MEASURED ] {} x {}, baseline {:.2f} m: {:.1f} % valid, {:.2f} % of them wrong\n", cloud.width,
             cloud.height, cloud.baseline, 100 * seen.valid, 100 * seen.bad);
  EXPECT_GT(seen.valid, 0.5);
  EXPECT_LT(seen.bad, 0.03);
}

depth_cloud_t last_cloud(const BumblebeeRig& rig, float baseline_m) {
  const auto clouds = rig.bus.clouds();
  for (auto cloud = clouds.rbegin(); cloud != clouds.rend(); ++cloud)
    if (std::abs(cloud->message.baseline - baseline_m) < 0.001F) return cloud->message;
  ADD_FAILURE() << "no cloud of " << baseline_m << " m";
  return {};
}

TEST(Bumblebee2, StreamsWhatItsEyesSee) {
  BumblebeeRig rig;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(12));
  rig.stop();
  const depth_cloud_t cloud = last_cloud(rig, 0.12F);
  EXPECT_EQ(cloud.width, 640);
  EXPECT_EQ(cloud.sensor, depth_cloud_t::BUMBLEBEE);
  EXPECT_EQ(cloud.meaning, depth_cloud_t::DISPARITY);
  EXPECT_EQ(cloud.uncertainty_size, 640 * 480);
  expect_shows_the_room(rig, cloud);
  EXPECT_EQ(rig.camera()->packet_bytes, 1152);
}

/// Steps between utimes are whole frames as the camera counted them, and utime is that of the exposure.
TEST(Bumblebee2, StampsTheExposure) {
  BumblebeeRig rig;
  rig.camera()->clock_ppm = 50;
  rig.settings.auto_exposure = false;
  rig.settings.shutter_ms = 8;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(20));
  rig.stop();
  const auto clouds = rig.bus.clouds();
  const double period_us = static_cast<double>(transfer_us(640LL * 480 * 2, 1152));
  expect_frames_count_exposures(clouds, static_cast<int>(period_us));
  std::vector<double> off_ms;
  for (const auto& cloud : clouds) {
    const auto wall = std::chrono::system_clock::now().time_since_epoch() - Clock::now().time_since_epoch();
    const double exposure_us =
        static_cast<double>(cloud.message.utime) -
        static_cast<double>(std::chrono::duration_cast<std::chrono::microseconds>(wall).count());
    const double steps = (exposure_us - static_cast<double>(rig.camera()->origin_us)) / period_us;
    off_ms.push_back(std::abs(steps - std::round(steps)) * period_us * 1e-3);
  }
  std::sort(off_ms.begin(), off_ms.end());
  fmt::print("[ MEASURED ] utime off by {:.2f} ms in the median\n", off_ms[off_ms.size() / 2]);
  EXPECT_TRUE(off_ms[off_ms.size() / 2] < 3 || !long_form());
  EXPECT_NEAR(rig.camera()->shutter, 8000, 10);
}

constexpr std::int32_t kShutterBit = 1 << 7;  // numbers of IIDC's features
constexpr std::int32_t kGainBit = 1 << 8;

TEST(Bumblebee2, KeepsAFixedShutterUnderAutomaticGain) {
  BumblebeeRig rig;
  rig.settings.auto_exposure = false;
  rig.settings.shutter_ms = 5;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(1));
  EXPECT_EQ(rig.camera()->automatic, kGainBit);
  EXPECT_NEAR(rig.camera()->shutter, 5000, 10);
}

TEST(Bumblebee2, FixesAGainThatTheCameraCannotChoose) {
  BumblebeeRig rig;
  rig.camera()->without_automatic_gain = 1;
  rig.camera().unplug();
  std::this_thread::sleep_for(20ms);
  rig.camera().plug();
  rig.settings.gain_db = 4;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(1));
  EXPECT_EQ(rig.camera()->automatic, kShutterBit);
  EXPECT_NEAR(rig.camera()->gain, 400, 1);
}

TEST(BumblebeeXb3, StreamsTheWidePair) {
  BumblebeeRig rig(bumblebee_xb3_rig());
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(2));
  rig.stop();
  expect_shows_the_room(rig, last_cloud(rig, 0.24F));
  EXPECT_EQ(rig.camera()->packet_bytes, 2304);
}

TEST(BumblebeeXb3, StreamsTheNarrowPairAtHalfSize) {
  BumblebeeRig rig(bumblebee_xb3_rig());
  rig.settings.pair = "narrow";
  rig.settings.half_size = true;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(2));
  rig.stop();
  const depth_cloud_t cloud = last_cloud(rig, 0.12F);
  EXPECT_EQ(cloud.width, 640);
  expect_shows_the_room(rig, cloud);
}

TEST(BumblebeeXb3, StreamsBothPairs) {
  BumblebeeRig rig(bumblebee_xb3_rig());
  rig.settings.pair = "both";
  rig.settings.half_size = true;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(4));
  rig.stop();
  expect_shows_the_room(rig, last_cloud(rig, 0.24F));
  expect_shows_the_room(rig, last_cloud(rig, 0.12F));
}

class BumblebeeFaults : public testing::Test {
 protected:
  void start() {
    rig.start();
    ASSERT_TRUE(rig.wait_for_clouds(3));
    ASSERT_TRUE(rig.wait_for_state(health_t::OK, ""));
  }
  void expect_told(std::int8_t state, const std::string& reason, const char* what, double within_ms = 2500) {
    const auto begin = Clock::now();
    ASSERT_TRUE(rig.wait_for_state(state, reason)) << rig.bus.health()->reason;
    measured(what, ms_since(begin), within_ms);
  }
  void expect_clouds_again(const char* what) {
    const auto begin = Clock::now();
    rig.bus.forget_clouds();
    EXPECT_TRUE(rig.wait_for_clouds(1));
    measured(what, ms_since(begin), 3000);
    EXPECT_TRUE(rig.wait_for_state(health_t::OK, ""));
  }
  void expect_last_cloud_shows_the_room() {
    rig.stop();
    expect_shows_the_room(rig, last_cloud(rig, 0.12F));
  }
  BumblebeeRig rig;
};

TEST_F(BumblebeeFaults, UnpluggedAndPluggedInAgain) {
  start();
  rig.camera().unplug();
  expect_told(health_t::FAULT, "gone", "unplugged, told in HEALTH");
  std::this_thread::sleep_for(300ms);
  rig.camera().plug();
  expect_clouds_again("plugged in again, frames after");
  expect_last_cloud_shows_the_room();
}

TEST_F(BumblebeeFaults, FoundWhereTheWholeBusComesLater) {
  rig.camera()->no_bus = 1;
  std::this_thread::sleep_for(20ms);
  rig.start();
  ASSERT_TRUE(rig.wait_for_state(health_t::FAULT, "/dev/fw"));
  rig.camera()->no_bus = 0;
  expect_clouds_again("bus there after the start, frames after");
}

TEST_F(BumblebeeFaults, FallsSilentAndWakesUp) {
  start();
  rig.camera()->stalled = 1;
  expect_told(health_t::FAULT, "silent", "fallen silent, told in HEALTH");
  rig.camera()->stalled = 0;
  expect_clouds_again("no longer silent, frames after");
}

TEST_F(BumblebeeFaults, LostFramesAreCounted) {
  start();
  rig.camera()->drop = 5;
  expect_told(health_t::DEGRADED, "loses frames", "frames lost, told in HEALTH");
  EXPECT_GE(rig.bus.drops("frame lost by the device"), 1);
  EXPECT_TRUE(rig.wait_for_state(health_t::OK, ""));
  EXPECT_GE(rig.bus.drops("frame lost by the device"), 5);
}

TEST_F(BumblebeeFaults, WithoutStampsLostFramesAreSeenByTheClock) {
  rig.camera()->without_stamps = 1;
  rig.camera().unplug();
  std::this_thread::sleep_for(20ms);
  rig.camera().plug();
  start();
  rig.camera()->drop = 4;
  ASSERT_TRUE(rig.wait_for_state(health_t::DEGRADED, "loses frames"));
  const auto deadline = Clock::now() + 20s;
  while (rig.bus.drops("frame lost by the device") < 3 && Clock::now() < deadline)
    std::this_thread::sleep_for(5ms);
  EXPECT_GE(rig.bus.drops("frame lost by the device"), 3);
}

TEST_F(BumblebeeFaults, GoesOnThroughABusReset) {
  rig.settings.silence_ms = 10'000;
  start();
  for (int i = 0; i < 3; ++i) {
    ++rig.camera()->bus_resets;
    rig.bus.forget_clouds();
    ASSERT_TRUE(rig.wait_for_clouds(2));
  }
  EXPECT_EQ(rig.status().opened, 1);
}

TEST_F(BumblebeeFaults, StartsAgainWhereABusResetStopsTheCamera) {
  start();
  rig.camera()->reset_stops = 1;
  ++rig.camera()->bus_resets;
  expect_told(health_t::FAULT, "silent", "stopped by a bus reset, told in HEALTH");
  expect_clouds_again("after a bus reset, frames after");
}

TEST_F(BumblebeeFaults, LostPacketsAreNoticedAndTheFramesFoundAgain) {
  rig.settings.silence_ms = 10'000;
  start();
  rig.camera()->lose_packets = 1;
  const auto begin = Clock::now();
  while (rig.status().opened < 2 && ms_since(begin) < 20'000) std::this_thread::sleep_for(5ms);
  measured("packets lost, opened again after", ms_since(begin), 3000);
  EXPECT_GE(rig.status().drops["frame out of step"], 3);
  rig.bus.forget_clouds();
  ASSERT_TRUE(rig.wait_for_clouds(2));
  expect_last_cloud_shows_the_room();
}

TEST_F(BumblebeeFaults, AStuckImageIsToldAndNotPublished) {
  start();
  rig.camera()->frozen = 1;
  expect_told(health_t::FAULT, "same image", "stuck image, told in HEALTH");
  const std::size_t published = rig.bus.clouds().size();
  std::this_thread::sleep_for(400ms);
  EXPECT_EQ(rig.bus.clouds().size(), published);
  rig.camera()->frozen = 0;
  expect_clouds_again("image changes again, frames after");
}

TEST_F(BumblebeeFaults, ABlackImageIsPublishedAsNothingSeen) {
  rig.settings.stuck_after = 0;
  start();
  rig.camera()->black = 1;
  expect_told(health_t::DEGRADED, "no pixel", "black image, told in HEALTH");
  rig.bus.forget_clouds();
  EXPECT_TRUE(rig.wait_for_clouds(3));
}

TEST_F(BumblebeeFaults, ASlowConsumerGetsTheNewestFrameAndNobodyIsBlamed) {
  rig.settings.frames_per_second = 50;
  rig.settings.stereo.matcher = "sgbm";
  rig.settings.buffers = 4;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(10));
  EXPECT_GT(rig.bus.drops("frame superseded") + rig.status().drops["frame superseded"], 0);
  rig.stop();
  for (const auto& cloud : rig.bus.clouds()) EXPECT_GT(cloud.message.frame, 0);
}

TEST_F(BumblebeeFaults, ABusWithoutBandwidthIsTold) {
  rig.camera()->bandwidth_taken = 1;
  rig.start();
  ASSERT_TRUE(rig.wait_for_state(health_t::FAULT, "bandwidth"));
  rig.camera()->bandwidth_taken = 0;
  expect_clouds_again("bandwidth free again, frames after");
}

TEST_F(BumblebeeFaults, ACameraWithoutCalibrationIsTold) {
  rig.camera()->without_calibration = 1;
  rig.camera().unplug();
  std::this_thread::sleep_for(20ms);
  rig.camera().plug();
  rig.start();
  EXPECT_TRUE(rig.wait_for_state(health_t::FAULT, "calibration"));
}

TEST_F(BumblebeeFaults, AnAnswerThatDoesNotComeIsTold) {
  start();
  rig.camera().unplug();
  ASSERT_TRUE(rig.wait_for_state(health_t::FAULT, "gone"));
  rig.camera()->requests_hang = 1;
  rig.camera().plug();
  expect_told(health_t::FAULT, "has not come back from opening", "requests hang, told in HEALTH", 5000);
  rig.camera()->requests_hang = 0;
  expect_clouds_again("requests answered again, frames after");
}

/// A device that answers every register with anything: nothing crashes, each attempt ends in a line.
TEST_F(BumblebeeFaults, RandomRegistersAreRefusedWithoutACrash) {
  FirewireCamera camera(rig.settings);
  rig.camera()->random_registers = 1;
  const int attempts = long_form() ? 500 : 20;
  int refused = 0;
  for (int i = 0; i < attempts; ++i) {
    try {
      camera.open_stream();
      camera.close();
    } catch (const DeviceError& error) {
      ++refused;
      EXPECT_FALSE(std::string(error.what()).empty());
    }
  }
  EXPECT_GT(refused, attempts / 2);
  rig.camera()->random_registers = 0;
  start();
}

/// Reconnects by unplugging, as fast as frames come again. Of a camera that goes libdc1394 itself keeps what
/// describes its ring, 6 kB; nothing else may grow.
TEST_F(BumblebeeFaults, ReconnectsLeakNothing) {
  constexpr double kLibraryLoses_kb = 6;
  constexpr int kSettle = 5;
  const int reconnects = long_form() ? 500 : 15;
  start();
  expect_no_leak(resources_over_reconnects(rig, rig.camera(), kSettle, reconnects),
                 2 * kLibraryLoses_kb * reconnects + 8000);
}

}  // namespace
}  // namespace floornav
