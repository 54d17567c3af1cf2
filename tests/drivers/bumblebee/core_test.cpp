// The values in and values out of the driver: registers, packets, stamps, eyes, the region that is matched.
#include <numbers>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "drivers/bumblebee/camera_registers.hpp"
#include "drivers/bumblebee/eye_images.hpp"
#include "drivers/bumblebee/frame_stamp.hpp"
#include "drivers/bumblebee/roi_search.hpp"
#include "drivers/camera/mounting.hpp"

namespace floornav {
namespace {

TEST(SensorType, OfTheRegister) {
  EXPECT_EQ(sensor_type_of(0xA)->width, 640);
  EXPECT_TRUE(sensor_type_of(0xA)->color);
  EXPECT_FALSE(sensor_type_of(0xB)->color);
  EXPECT_EQ(sensor_type_of(0xC)->height, 768);
  EXPECT_EQ(sensor_type_of(0xE)->width, 1280);
  EXPECT_FALSE(sensor_type_of(0x3).has_value());
}

TEST(BayerPattern, IsFourLetters) {
  EXPECT_EQ(bayer_pattern_of(0x47425247), "GBRG");
  EXPECT_EQ(bayer_pattern_of(0x00FF5247), "??RG");
}

/// The known figures of the pairs: 1280x960 at 15 and 7.5 Hz, 640x480 at 15 Hz.
TEST(Packets, AreOfTheRate) {
  EXPECT_EQ(packet_bytes_for(15, 1280LL * 960 * 2, 800), 4608);
  EXPECT_EQ(packet_bytes_for(7.5, 1280LL * 960 * 2, 800), 2304);
  EXPECT_EQ(packet_bytes_for(15, 640LL * 480 * 2, 400), 1152);
  EXPECT_THROW((void)packet_bytes_for(15, 1280LL * 960 * 2, 400), std::runtime_error);
  EXPECT_LE(packet_bytes_for(26.6, 1280LL * 960 * 2, 800), 8188);
  EXPECT_EQ(transfer_us(1280LL * 960 * 2, 2304), 133'375);
}

TEST(FrameStamp, IsTakenOutOfTheImage) {
  std::vector<std::uint8_t> frame = {0x12, 0x34, 0x56, 0x78, 0, 0, 1, 2, 9, 8, 7, 6, 5, 4, 3, 2, 1};
  const FrameStamp stamp = take_stamp(frame);
  EXPECT_EQ(stamp.cycle_time, 0x12345678U);
  EXPECT_EQ(stamp.counter, 258U);
  EXPECT_EQ(frame[0], 9);
  EXPECT_EQ(frame[7], 2);
}

std::uint32_t cycle_time_of(std::int64_t us) {
  const auto in_turn = static_cast<std::uint32_t>(us % 128'000'000);
  return in_turn / 1'000'000 << 25 | in_turn % 1'000'000 / 125 << 12 | in_turn % 125 * 3072 / 125;
}

class CycleClockOverAGap : public testing::TestWithParam<std::int64_t> {};

TEST_P(CycleClockOverAGap, GoesOn) {
  CycleClock clock;
  const std::int64_t first = 127'900'000;
  const auto before = static_cast<std::int64_t>(clock.us(cycle_time_of(first), 5'000'000));
  const std::int64_t gap = GetParam();
  const auto after =
      static_cast<std::int64_t>(clock.us(cycle_time_of(first + gap), 5'000'000 + gap + 20'000));
  EXPECT_NEAR(static_cast<double>(after - before), static_cast<double>(gap), 2);
}

INSTANTIATE_TEST_SUITE_P(Gaps, CycleClockOverAGap,
                         testing::Values(66'667, 133'333, 1'000'000, 63'000'000, 100'000'000, 400'000'000));

TEST(EyeImages, AreTakenApart) {
  const std::vector<std::uint8_t> frame = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const auto two = EyeImages({3, 2, 2, ""}).split(frame);
  EXPECT_EQ(two[0].at<std::uint8_t>(0, 1), 3);
  EXPECT_EQ(two[1].at<std::uint8_t>(1, 2), 12);
  const auto three = EyeImages({2, 2, 3, ""}).split(frame);
  EXPECT_EQ(three[2].at<std::uint8_t>(0, 1), 6);
  EXPECT_THROW((void)EyeImages({3, 3, 2, ""}).split(frame), std::runtime_error);
  EXPECT_THROW(EyeImages({4, 4, 2, "GBGB"}), std::runtime_error);
}

/// Each pattern gives back a scene of one colour without a trace of the mosaic, and green weighs most.
TEST(EyeImages, AreWithoutTheMosaic) {
  for (const std::string bayer : {"RGGB", "GRBG", "GBRG", "BGGR"}) {
    std::vector<std::uint8_t> frame(16 * 16);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const char color = bayer[2 * (i / 16 % 2) + i % 2];
      frame[i] = color == 'R' ? 200 : color == 'G' ? 100 : 50;
    }
    EyeImages eyes({16, 16, 1, bayer});
    const cv::Mat grey = eyes.split(frame)[0](cv::Rect(3, 3, 10, 10));
    double least = 0;
    double most = 0;
    cv::minMaxLoc(grey, &least, &most);
    EXPECT_LE(most - least, 1) << bayer;
    EXPECT_NEAR(most, 0.299 * 200 + 0.587 * 100 + 0.114 * 50, 2) << bayer;
  }
}

class SearchedRows : public testing::TestWithParam<unsigned> {};

/// Every point of the region that the camera sees lies in its row's range, and the ranges together are little
/// wider than random points make them.
TEST_P(SearchedRows, HoldWhatTheRegionShows) {
  std::mt19937 random(GetParam());
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const MatchedRegion region;
  const Pinhole camera{500, 500, 319.5F, 239.5F, 640, 480};
  MountingSettings mounting;
  mounting.pitch_deg = between(5, 40);
  mounting.roll_deg = between(-10, 10);
  const Pose T_body_sensor = sensor_in_body(mounting);
  const double baseline_m = 0.12;
  const double nearest_m = 0.6;
  const auto rows = search_of(region, camera, baseline_m, T_body_sensor, nearest_m);
  std::vector<RowSearch> seen(rows.size());
  for (int i = 0; i < 400'000; ++i) {
    const Eigen::Vector3d p(between(region.x_min_m, region.x_max_m), between(region.y_min_m, region.y_max_m),
                            between(region.z_min_m, region.z_max_m));
    const Eigen::Vector3f s = (T_body_sensor.inverse() * p).cast<float>();
    if (s.z() < static_cast<float>(nearest_m)) continue;
    const Eigen::Vector2f at = camera.project(s);
    if (at.x() < 0 || at.y() < 0 || at.x() > 639 || at.y() > 479) continue;
    const auto row = static_cast<std::size_t>(std::lround(at.y()));
    const float disparity = camera.fx * static_cast<float>(baseline_m) / s.z();
    seen[row].add({disparity, disparity});
    EXPECT_GE(disparity, rows[row].least_px - 0.5F);
    EXPECT_LE(disparity, rows[row].most_px + 0.5F);
  }
  float claimed = 0;
  float shown = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    claimed += rows[row].empty() ? 0 : rows[row].most_px - rows[row].least_px;
    shown += seen[row].empty() ? 0 : seen[row].most_px - seen[row].least_px;
  }
  EXPECT_LT(claimed, 1.3F * shown);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SearchedRows, testing::Range(0U, 4U));

}  // namespace
}  // namespace floornav
