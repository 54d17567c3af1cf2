#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "mapping/grid_map.hpp"

namespace floornav {
namespace {

using Times = GridTile::Seen;

class SeenTimesOf : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, SeenTimesOf, testing::Range(1U, 6U));

/// Times across the wrap of the 32-bit counter for odd seeds.
std::uint32_t first_time(unsigned seed) {
  return seed % 2 == 1 ? 0U - 40'000U : 32'000U + seed;
}

TEST_P(SeenTimesOf, AnHourAreExactInAnyOrder) {
  std::mt19937 random(GetParam());
  Times times;
  std::array<std::uint32_t, GridTile::kVertices> expected{};
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t vertex = random() % expected.size();
    const std::uint32_t time = first_time(GetParam()) + static_cast<std::uint32_t>(random() % 65'000);
    expected[vertex] = random() % 10 == 0 || time == 0 ? 0 : time;
    times.set(vertex, expected[vertex]);
  }
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(times[i], expected[i]);
}

TEST_P(SeenTimesOf, DaysAreExactWithinWhatAMessageTellsAndNoYoungerBeyond) {
  std::mt19937 random(GetParam());
  Times times;
  std::array<std::uint32_t, GridTile::kVertices> expected{};
  std::uint32_t now = first_time(GetParam());
  for (int i = 0; i < 20'000; ++i) {
    now += static_cast<std::uint32_t>(random() % 300);
    if (now == 0) now = 1;
    const std::size_t vertex = random() % (i < 100 ? expected.size() : 40);
    expected[vertex] = now;
    times.set(vertex, now);
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::uint32_t age = now - expected[i];
    if (expected[i] == 0) {
      ASSERT_EQ(times[i], 0U);
    } else if (age <= static_cast<std::uint32_t>(Times::kExact)) {
      ASSERT_EQ(times[i], expected[i]);
    } else {
      ASSERT_GE(now - times[i], static_cast<std::uint32_t>(Times::kExact));
    }
  }
}

TEST(SeenTimes, AreTheSameWhateverTheyWereCountedFrom) {
  Times a;
  Times b;
  a.set(3, 1'000'000);
  b.set(4, 1'030'000);
  EXPECT_FALSE(a == b);
  a.set(4, 1'030'000);
  b.set(3, 1'000'000);
  EXPECT_TRUE(a == b);
}

TEST(SigmaCode, EveryCodeIsTheCountsThatItTellsAndNoCountsAreMissedByMoreThan3Percent) {
  for (int code = 0; code <= 191; ++code)
    ASSERT_EQ(sigma_code(sigma_counts(static_cast<std::uint8_t>(code))), code);
  for (int counts = 0; counts <= 31'000; ++counts) {
    const int told = sigma_counts(sigma_code(static_cast<std::int16_t>(counts)));
    ASSERT_LE(std::abs(told - counts), counts < 32 ? 0.0 : 0.031 * counts);
  }
  EXPECT_EQ(sigma_counts(sigma_code(kUnknownSigma)), kUnknownSigma);
  EXPECT_EQ(sigma_counts(sigma_code(-5)), 0);
}

TEST(VertexStates, AreHeldOneByOne) {
  std::mt19937 random(1);
  VertexStates<GridTile::kVertices> states;
  EXPECT_EQ(states.count(VertexState::kUnknown), states.size());
  std::array<VertexState, GridTile::kVertices> expected{};
  for (int i = 0; i < 10'000; ++i) {
    const std::size_t vertex = random() % expected.size();
    states[vertex] = expected[vertex] = static_cast<VertexState>(random() % 3);
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_EQ(static_cast<VertexState>(states[i]), expected[i]);
  EXPECT_EQ(states.count(VertexState::kFree),
            static_cast<std::size_t>(std::ranges::count(expected, VertexState::kFree)));
}

}  // namespace
}  // namespace floornav
