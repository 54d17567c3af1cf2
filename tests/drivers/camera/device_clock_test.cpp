#include "drivers/camera/device_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr std::int64_t kWay_us = 33'000;
constexpr double kPeriod_us = 1e6 / 30;

/// A camera whose exposures are known, and a host that sees its frames late.
struct Camera {
  double clock_ppm = 0;
  double stamps_per_us = 1;
  double first_stamp = 1e9;
  std::uint64_t mask = ~std::uint64_t{0};
  double jitter_us = 0;
  std::int64_t monotonic_start_us = 5'000'000'000;
  std::int64_t wall_minus_monotonic_us = 1'700'000'000'000'000;
  std::minstd_rand random{1};

  [[nodiscard]] std::int64_t exposure_us(int frame) const {
    return monotonic_start_us + std::llround(frame * kPeriod_us);
  }
  [[nodiscard]] std::uint64_t stamp(int frame) const {
    const double us = first_stamp + frame * kPeriod_us * (1 + clock_ppm * 1e-6);
    return static_cast<std::uint64_t>(us * stamps_per_us) & mask;
  }
  HostTime arrival(int frame) {
    const double late = std::uniform_real_distribution<double>(0, jitter_us)(random);
    const std::int64_t monotonic = exposure_us(frame) + kWay_us + static_cast<std::int64_t>(late);
    return {monotonic, monotonic + wall_minus_monotonic_us};
  }
  [[nodiscard]] std::int64_t true_utime(int frame) const {
    return exposure_us(frame) + wall_minus_monotonic_us;
  }
};

/// How far off the mapping is, us.
double error_us(DeviceClock& clock, Camera& camera, int frame) {
  return static_cast<double>(clock.utime_of(camera.stamp(frame), camera.arrival(frame)) -
                             camera.true_utime(frame));
}

TEST(DeviceClock, MapsSteadyFramesToTheirExposures) {
  Camera camera;
  DeviceClock clock(kWay_us);
  for (int frame = 0; frame < 1000; ++frame) ASSERT_NEAR(error_us(clock, camera, frame), 0, 20) << frame;
  EXPECT_EQ(clock.restarts(), 0);
}

class DeviceClockDrift : public testing::TestWithParam<double> {};

/// An hour of a clock that is too fast or too slow, with frames up to 15 ms late.
TEST_P(DeviceClockDrift, StaysWithinThreeMillisecondsOfTheExposureForAnHour) {
  Camera camera;
  camera.clock_ppm = GetParam();
  camera.jitter_us = 15'000;
  DeviceClock clock(kWay_us);
  constexpr int kSettled = 300;
  double worst = 0;
  for (int frame = 0; frame < 3600 * 30; ++frame) {
    const double error = std::abs(error_us(clock, camera, frame));
    if (frame > kSettled) worst = std::max(worst, error);
  }
  EXPECT_LT(worst, 3000);
  EXPECT_EQ(clock.restarts(), 0);
}

TEST_P(DeviceClockDrift, NeverJumps) {
  Camera camera;
  camera.clock_ppm = GetParam();
  camera.jitter_us = 40'000;
  DeviceClock clock(kWay_us);
  std::int64_t last = clock.utime_of(camera.stamp(0), camera.arrival(0));
  for (int frame = 1; frame < 10'000; ++frame) {
    const std::int64_t utime = clock.utime_of(camera.stamp(frame), camera.arrival(frame));
    ASSERT_NEAR(static_cast<double>(utime - last), kPeriod_us, 0.011 * kPeriod_us) << frame;
    last = utime;
  }
}

INSTANTIATE_TEST_SUITE_P(Ppm, DeviceClockDrift, testing::Values(-200.0, -50.0, 0.0, 50.0, 200.0));

TEST(DeviceClock, FollowsARawSixtyMegahertzClockAcrossItsWrap) {
  Camera camera;
  camera.stamps_per_us = 60;
  camera.mask = 0xFFFFFFFF;
  camera.first_stamp = 1e6;
  DeviceClock clock(kWay_us);
  for (int frame = 0; frame < 20 * 60 * 30; ++frame)  // wraps every 71.6 s
    ASSERT_NEAR(error_us(clock, camera, frame), 0, 100) << frame;
  EXPECT_EQ(clock.restarts(), 0);
}

TEST(DeviceClock, FollowsMicrosecondsThatWrapAt32Bits) {
  Camera camera;
  camera.mask = 0xFFFFFFFF;
  camera.first_stamp = 4'294'000'000;  // wraps in a second
  DeviceClock clock(kWay_us);
  for (int frame = 0; frame < 300; ++frame) ASSERT_NEAR(error_us(clock, camera, frame), 0, 100) << frame;
  EXPECT_EQ(clock.restarts(), 0);
}

TEST(DeviceClock, FollowsAWallClockThatStepsAtTheNextFrame) {
  constexpr std::int64_t kHour_us = 3'600'000'000;
  Camera camera;
  DeviceClock clock(kWay_us);
  for (const std::int64_t step : {kHour_us, -2 * kHour_us, kHour_us}) {
    camera.wall_minus_monotonic_us += step;
    for (int frame = 0; frame < 100; ++frame) ASSERT_NEAR(error_us(clock, camera, frame), 0, 20);
    camera.monotonic_start_us = camera.exposure_us(100);
    camera.first_stamp += 100 * kPeriod_us;
  }
  EXPECT_EQ(clock.restarts(), 0);
}

TEST(DeviceClock, GoesOnAfterAGap) {
  Camera camera;
  DeviceClock clock(kWay_us);
  for (const int frame : {0, 1, 2, 3, 300, 301, 9000, 9001})
    ASSERT_NEAR(error_us(clock, camera, frame), 0, 50) << frame;
  EXPECT_EQ(clock.restarts(), 0);
}

TEST(DeviceClock, StartsAgainWhereTheStampsDo) {
  Camera camera;
  DeviceClock clock(kWay_us);
  for (int frame = 0; frame < 100; ++frame) clock.utime_of(camera.stamp(frame), camera.arrival(frame));
  camera.first_stamp = 0;  // a file from its beginning again
  camera.monotonic_start_us = camera.exposure_us(100);
  for (int frame = 0; frame < 100; ++frame) ASSERT_NEAR(error_us(clock, camera, frame), 0, 50) << frame;
  EXPECT_EQ(clock.restarts(), 1);
}

TEST(DeviceClock, TakesArrivalsWhereTheStampsStandStill) {
  Camera camera;
  DeviceClock clock(kWay_us);
  for (int frame = 0; frame < 100; ++frame)
    ASSERT_NEAR(static_cast<double>(clock.utime_of(7, camera.arrival(frame)) - camera.true_utime(frame)), 0,
                20);
}

/// A cable that is longer from now on: what arrives is older than the clock alone could tell.
TEST(DeviceClock, LearnsThatTheWayHasBecomeLonger) {
  constexpr std::int64_t kLonger_us = 100'000;
  Camera camera;
  DeviceClock clock(kWay_us);
  double error = 0;
  for (int frame = 0; frame < 600; ++frame) {
    HostTime arrival = camera.arrival(frame);
    arrival.monotonic_us += frame < 100 ? 0 : kLonger_us;
    arrival.utime_us += frame < 100 ? 0 : kLonger_us;
    error = static_cast<double>(clock.utime_of(camera.stamp(frame), arrival) - camera.true_utime(frame));
  }
  EXPECT_NEAR(error, kLonger_us, 1000);
}

TEST(DeviceClock, PlacesWhatIsStampedNearTheLastFrame) {
  for (const double stamps_per_us : {1.0, 60.0}) {
    Camera camera;
    camera.stamps_per_us = stamps_per_us;
    camera.mask = 0xFFFFFFFF;
    camera.first_stamp = 1e6;
    DeviceClock clock(kWay_us);
    for (int frame = 0; frame < 90 * 30; ++frame) {  // across the wrap of the raw clock
      clock.utime_of(camera.stamp(frame), camera.arrival(frame));
      if (frame < 2) continue;
      for (const int other : {frame - 1, frame, frame + 1})
        ASSERT_NEAR(
            static_cast<double>(clock.utime_near_last(camera.stamp(other)) - camera.true_utime(other)), 0,
            500)
            << frame;
    }
  }
}

}  // namespace
}  // namespace floornav
