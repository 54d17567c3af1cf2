// The driver's utime against the virtual Kinect's exposures, which are known.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/drivers/kinect/driver_rig.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

std::int64_t wall_minus_monotonic_us() {
  const auto us = [](auto now) {
    return std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch()).count();
  };
  return us(std::chrono::system_clock::now()) - us(std::chrono::steady_clock::now());
}

/// Each cloud's utime minus the exposure that is nearest to it, ms, sorted.
std::vector<double> errors_ms(DriverRig& rig, int period_us) {
  std::vector<double> errors;
  const std::int64_t offset = wall_minus_monotonic_us();
  const auto clouds = rig.bus.clouds();
  for (std::size_t i = clouds.size() / 2; i < clouds.size(); ++i) {
    const std::int64_t exposure = clouds[i].message.utime - offset - rig.kinect()->origin_us;
    const double phase = std::remainder(static_cast<double>(exposure), static_cast<double>(period_us));
    errors.push_back(std::abs(phase) * 1e-3);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

struct ClockCase {
  const char* name;
  std::int32_t transfer_us;
  std::int32_t jitter_us;
  std::int32_t clock_ppm;
  std::int32_t clock_60_mhz;
};

class KinectClock : public testing::TestWithParam<ClockCase> {};

TEST_P(KinectClock, GivesTheMiddleOfTheExposure) {
  const ClockCase& device = GetParam();
  DriverRig rig;
  rig.kinect()->transfer_us = device.transfer_us;
  rig.kinect()->jitter_us = device.jitter_us;
  rig.kinect()->clock_ppm = device.clock_ppm;
  rig.kinect()->clock_60_mhz = device.clock_60_mhz;
  rig.settings.exposure_to_arrival_ms = device.transfer_us * 1e-3;
  rig.start();
  ASSERT_TRUE(rig.wait_for_clouds(120, 20s));
  const std::vector<double> errors = errors_ms(rig, RoomScene().period_us);
  fmt::print("[ MEASURED ] utime off by {:.2f} ms in the median, {:.2f} ms at most\n",
             errors[errors.size() / 2], errors.back());
  EXPECT_LT(errors[errors.size() / 2], 10.0);  // a loaded machine adds to it
}

INSTANTIATE_TEST_SUITE_P(Devices, KinectClock,
                         testing::Values(ClockCase{"Steady", 33'000, 0, 0, 0},
                                         ClockCase{"LateAndDrifting", 20'000, 10'000, 100, 0},
                                         ClockCase{"RawCounts", 33'000, 2'000, -100, 1}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace floornav
