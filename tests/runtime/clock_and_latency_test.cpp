#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/process/latency.hpp"
#include "runtime/process/log_clock.hpp"

namespace floornav {
namespace {

TEST(LogClock, FollowsStampsAndNeverGoesBack) {
  LogClock clock;
  EXPECT_FALSE(clock.started());
  EXPECT_EQ(clock.advance(5'000'000), Micros(5'000'000));
  EXPECT_EQ(clock.advance(5'100'000), Micros(5'100'000));
  EXPECT_EQ(clock.advance(5'050'000), Micros(5'100'000));  // messages overtake each other
  EXPECT_EQ(clock.advance(5'120'000), Micros(5'120'000));
  EXPECT_EQ(clock.jumps(), 0);
}

TEST(LogClock, GoesOnAfterAnHourEitherWay) {
  const std::int64_t hour = 3'600'000'000;
  LogClock clock;
  clock.advance(10 * hour);
  EXPECT_EQ(clock.advance(11 * hour), Micros(10 * hour));
  EXPECT_EQ(clock.advance(11 * hour + 1000), Micros(10 * hour + 1000));
  EXPECT_EQ(clock.advance(9 * hour), Micros(10 * hour + 1000));
  EXPECT_EQ(clock.advance(9 * hour + 500), Micros(10 * hour + 1500));
  EXPECT_EQ(clock.jumps(), 2);
}

class LatencyHistogramOf : public testing::TestWithParam<unsigned> {};

TEST_P(LatencyHistogramOf, AgreesWithTheSortedDurations) {
  std::mt19937 random(GetParam());
  std::lognormal_distribution<double> ms(1.0, 1.5);
  LatencyHistogram all;
  LatencyHistogram half;
  std::vector<double> sorted;
  for (int i = 0; i < 5000; ++i) {
    const auto duration = std::chrono::nanoseconds(static_cast<std::int64_t>(ms(random) * 1e6) + 1000);
    (i % 2 == 0 ? all : half).add(duration);
    sorted.push_back(static_cast<double>(duration.count()) * 1e-6);
  }
  all.merge(half);
  std::sort(sorted.begin(), sorted.end());
  for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
    const double exact = sorted[static_cast<std::size_t>(std::ceil(share * 5000)) - 1];
    EXPECT_NEAR(all.percentile_ms(share), exact, 0.03 * exact) << share;
  }
  EXPECT_DOUBLE_EQ(all.max_ms(), sorted.back());
  EXPECT_EQ(all.count(), 5000);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LatencyHistogramOf, testing::Range(0U, 5U));

TEST(LatencyHistogram, TakesNothingAndExtremes) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.percentile_ms(0.5), 0.0);
  histogram.add(std::chrono::nanoseconds(0));
  EXPECT_EQ(histogram.percentile_ms(0.5), 0.0);
  histogram.add(std::chrono::hours(100));
  EXPECT_EQ(histogram.percentile_ms(1.0), 3.6e8);
}

TEST(RecentLatency, ForgetsWhatIsOlderThanTwoWindows) {
  using std::chrono::milliseconds;
  using std::chrono::seconds;
  const RecentLatency::Instant begin = RecentLatency::Instant{} + seconds(1000);
  RecentLatency latency;
  latency.add(milliseconds(500), begin);
  for (int s = 1; s < 15; ++s) latency.add(milliseconds(1), begin + seconds(s));
  EXPECT_EQ(latency.recent(begin + seconds(15)).max_ms(), 500.0);
  EXPECT_EQ(latency.recent(begin + seconds(15)).count(), 15);
  for (int s = 15; s < 25; ++s) latency.add(milliseconds(1), begin + seconds(s));
  EXPECT_EQ(latency.recent(begin + seconds(25)).max_ms(), 1.0);
  EXPECT_EQ(latency.recent(begin + seconds(100)).count(), 0);
  latency.add(milliseconds(2), begin + seconds(100));
  EXPECT_EQ(latency.recent(begin + seconds(100)).count(), 1);
}

TEST(LogClock, KeepsToOneTimeOverStreamsThatLagOrJump) {
  LogClock clock;
  clock.advance(100'000'000, "POSE");
  clock.advance(99'950'000, "CLOUD");
  EXPECT_EQ(clock.now(), Micros(100'000'000));
  clock.advance(99'950'000 - 30'000'000, "GOAL");  // sent by a tool with another clock: no effect
  EXPECT_EQ(clock.now(), Micros(100'000'000));
  clock.advance(5'000'000'000, "MAP_REQUEST");
  EXPECT_EQ(clock.now(), Micros(100'000'000));
  clock.advance(100'100'000, "POSE");
  EXPECT_EQ(clock.now(), Micros(100'100'000));
  EXPECT_EQ(clock.jumps(), 0);
}

}  // namespace
}  // namespace floornav
