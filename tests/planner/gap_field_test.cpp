#include "planner/gap_field.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

/// Squared distance in half cells from a cell's centre to another's square, cell by cell.
std::vector<std::int16_t> brute_force(const std::vector<std::uint8_t>& kinds, std::int32_t width,
                                      std::int32_t height, std::uint8_t obstacles, std::int32_t reach) {
  const std::int32_t cap = (2 * reach + 1) * (2 * reach + 1);
  std::vector<std::int16_t> gaps;
  for (std::int32_t y = 0; y < height; ++y)
    for (std::int32_t x = 0; x < width; ++x) {
      std::int32_t least = cap;
      for (std::int32_t v = 0; v < height; ++v)
        for (std::int32_t u = 0; u < width; ++u) {
          if ((kinds[static_cast<std::size_t>(v * width + u)] & obstacles) == 0) continue;
          const std::int32_t dx = std::max(0, 2 * std::abs(u - x) - 1),
                             dy = std::max(0, 2 * std::abs(v - y) - 1);
          least = std::min(least, dx * dx + dy * dy);
        }
      gaps.push_back(static_cast<std::int16_t>(least));
    }
  return gaps;
}

class GapFieldOfSeed : public testing::TestWithParam<unsigned> {};

TEST_P(GapFieldOfSeed, EqualsBruteForceAfterEveryChange) {
  std::mt19937 random(GetParam());
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const std::int32_t width = uniform(1, 100), height = uniform(1, 50),
                     reach = uniform(1, GetParam() % 8 == 0 ? 63 : 12);
  std::vector<std::uint8_t> kinds(static_cast<std::size_t>(width * height), 0);
  GapField field;
  field.reset(width, height, reach);
  for (int change = 0; change < 6; ++change) {
    CellRect rect{uniform(0, width - 1), uniform(0, height - 1), 0, 0};
    rect.x1 = uniform(rect.x0 + 1, width);
    rect.y1 = uniform(rect.y0 + 1, height);
    const int percent = uniform(0, 20);
    for (std::int32_t y = rect.y0; y < rect.y1; ++y)
      for (std::int32_t x = rect.x0; x < rect.x1; ++x)
        kinds[static_cast<std::size_t>(y * width + x)] =
            static_cast<std::uint8_t>(uniform(0, 99) < percent ? uniform(2, 3) : uniform(0, 1));
    field.update({kinds.data(), width, height, 2}, rect);
    const auto truth = brute_force(kinds, width, height, 2, reach);
    for (std::size_t i = 0; i < truth.size(); ++i)
      ASSERT_EQ(field[i], truth[i]) << "change " << change << " cell " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, GapFieldOfSeed, testing::Range(0U, 60U));

TEST(GapField, RefusesAReachThatItsNumbersCannotHold) {
  GapField field;
  EXPECT_THROW(field.reset(10, 10, 64), std::invalid_argument);
  EXPECT_THROW(field.reset(10, 10, 0), std::invalid_argument);
  EXPECT_NO_THROW(field.reset(10, 10, 63));
}

}  // namespace
}  // namespace floornav
