#include "drivers/camera/frame_content.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace floornav {
namespace {

using Verdict = FrameContent::Verdict;
using Pixels = std::vector<std::uint16_t>;

Pixels noise(unsigned seed, std::size_t size = 64 * 48) {
  std::minstd_rand random(seed);
  Pixels pixels(size);
  for (auto& pixel : pixels) pixel = static_cast<std::uint16_t>(1 + random() % 9000);
  return pixels;
}

TEST(FrameContent, ChangingImagesAreGood) {
  FrameContent content(0.2, 5);
  for (unsigned seed = 1; seed < 50; ++seed) EXPECT_EQ(content.look_at(noise(seed)), Verdict::kGood);
}

TEST(FrameContent, TheFifthEqualImageIsStuckAndADifferentOneEndsIt) {
  FrameContent content(0.2, 5);
  for (int i = 1; i < 5; ++i) EXPECT_EQ(content.look_at(noise(1)), Verdict::kGood) << i;
  EXPECT_EQ(content.look_at(noise(1)), Verdict::kStuck);
  EXPECT_EQ(content.look_at(noise(1)), Verdict::kStuck);
  EXPECT_EQ(content.look_at(noise(2)), Verdict::kGood);
}

/// Whichever pixel it is that differs, also in the tail that no block of eight words covers.
TEST(FrameContent, OneCountInOnePixelIsAChange) {
  const Pixels same = noise(1, 1003);
  for (std::size_t i = 0; i < same.size(); ++i) {
    FrameContent content(0.2, 2);
    content.look_at(same);
    Pixels other = same;
    other[i] = static_cast<std::uint16_t>(other[i] ^ 1U << (i % 16));
    if (other[i] == 0) continue;
    ASSERT_EQ(content.look_at(other), Verdict::kGood) << i;
  }
}

TEST(FrameContent, NothingIsEmptyAtOnceAndNeverStuck) {
  FrameContent content(0.2, 2);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(content.look_at(Pixels(64 * 48, 0)), Verdict::kEmpty);
}

TEST(FrameContent, FewerValidPixelsThanTheShareAreSparse) {
  FrameContent content(0.2, 5);
  Pixels pixels(1000, 0);
  std::fill_n(pixels.begin(), 199, std::uint16_t{700});
  EXPECT_EQ(content.look_at(pixels), Verdict::kSparse);
  std::fill_n(pixels.begin(), 200, std::uint16_t{700});
  EXPECT_EQ(content.look_at(pixels), Verdict::kGood);
}

TEST(FrameContent, StuckIsNotLookedForWhereItIsSwitchedOff) {
  FrameContent content(0.2, 0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(content.look_at(noise(1)), Verdict::kGood);
}

}  // namespace
}  // namespace floornav
