#include "drivers/camera/frame_gaps.hpp"

#include <gtest/gtest.h>

namespace floornav {
namespace {

constexpr std::int64_t kPeriod_us = 33'333;

TEST(FrameGaps, CountsTheNumbersThatAreMissing) {
  FrameGaps gaps(0);
  EXPECT_EQ(gaps.missing_before(17, 0), 0);
  EXPECT_EQ(gaps.missing_before(18, 0), 0);
  EXPECT_EQ(gaps.missing_before(21, 0), 2);
  EXPECT_EQ(gaps.missing_before(22, 0), 0);
}

TEST(FrameGaps, SeesByTheClockWhatTheNumbersHide) {
  FrameGaps gaps(kPeriod_us);
  EXPECT_EQ(gaps.missing_before(1, 0), 0);
  EXPECT_EQ(gaps.missing_before(2, kPeriod_us + 900), 0);
  EXPECT_EQ(gaps.missing_before(3, 5 * kPeriod_us - 900), 3);
}

TEST(FrameGaps, CountsAFrameThatBothTellOfOnce) {
  FrameGaps gaps(kPeriod_us);
  EXPECT_EQ(gaps.missing_before(1, 0), 0);
  EXPECT_EQ(gaps.missing_before(4, 3 * kPeriod_us), 2);
}

TEST(FrameGaps, BeginsAnewWhereTheNumbersDo) {
  FrameGaps gaps(kPeriod_us);
  EXPECT_EQ(gaps.missing_before(500, 0), 0);
  EXPECT_EQ(gaps.missing_before(1, 90 * kPeriod_us), 0);
  EXPECT_EQ(gaps.missing_before(3, 92 * kPeriod_us), 1);
}

TEST(FrameGaps, BelievesTheNumbersWhereTheClockGoesBack) {
  FrameGaps gaps(kPeriod_us);
  EXPECT_EQ(gaps.missing_before(1, 90 * kPeriod_us), 0);
  EXPECT_EQ(gaps.missing_before(2, 0), 0);
}

}  // namespace
}  // namespace floornav
