#include "tools/import/decimal_time.hpp"

#include <gtest/gtest.h>

namespace floornav {
namespace {

TEST(DecimalTime, KeepsMicrosecondsThatADoubleWouldLose) {
  EXPECT_EQ(utime_from_seconds("1305031229.528784"), 1305031229528784);
  EXPECT_EQ(utime_from_seconds("9007199254.740993"), 9007199254740993);  // 2^53 + 1
}

TEST(DecimalTime, FillsUpAndRoundsTheFraction) {
  EXPECT_EQ(utime_from_seconds("12"), 12'000'000);
  EXPECT_EQ(utime_from_seconds("12."), 12'000'000);
  EXPECT_EQ(utime_from_seconds("1305031225.9334"), 1305031225933400);
  EXPECT_EQ(utime_from_seconds("0.00000049"), 0);
  EXPECT_EQ(utime_from_seconds("0.9999995"), 1'000'000);
}

TEST(DecimalTime, RefusesWhatIsNoTime) {
  for (const char* text : {"", ".", ".5", "-1.0", "1e9", "nan", "1.2.3", "12 ", "1,5", "9999999999999.0"})
    EXPECT_FALSE(utime_from_seconds(text)) << text;
}

}  // namespace
}  // namespace floornav
