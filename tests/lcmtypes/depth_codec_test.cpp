#include "lcmtypes/depth_codec.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "tests/real_data.hpp"

namespace floornav {
namespace {

using Pixels = std::vector<std::uint16_t>;
using Bytes = std::vector<std::uint8_t>;
using Nibbles = std::vector<int>;

// The oracle: the code of the paper nibble by nibble, as simple and slow as it can be written.

void push_number(Nibbles& nibbles, std::uint64_t number) {
  while (number >= 8) {
    nibbles.push_back(static_cast<int>(number % 8) + 8);
    number /= 8;
  }
  nibbles.push_back(static_cast<int>(number));
}

Nibbles naive_nibbles(const Pixels& pixels) {
  Nibbles nibbles;
  std::int64_t previous = 0;
  for (std::size_t i = 0; i < pixels.size();) {
    std::size_t zeros = 0;
    while (i + zeros < pixels.size() && pixels[i + zeros] == 0) ++zeros;
    i += zeros;
    std::size_t others = 0;
    while (i + others < pixels.size() && pixels[i + others] != 0) ++others;
    push_number(nibbles, zeros);
    push_number(nibbles, others);
    for (; others > 0; --others, ++i) {
      const std::int64_t difference = pixels[i] - previous;
      push_number(nibbles,
                  static_cast<std::uint64_t>(difference >= 0 ? 2 * difference : -2 * difference - 1));
      previous = pixels[i];
    }
  }
  return nibbles;
}

Bytes packed(Nibbles nibbles) {
  while (nibbles.size() % 8 != 0) nibbles.push_back(0);
  Bytes bytes(nibbles.size() / 2);
  for (std::size_t i = 0; i < nibbles.size(); ++i) {
    const std::size_t byte = i / 8 * 4 + (3 - i % 8 / 2);  // a word's last byte holds its first two nibbles
    bytes[byte] = static_cast<std::uint8_t>(bytes[byte] | (i % 2 == 0 ? nibbles[i] << 4 : nibbles[i]));
  }
  return bytes;
}

Bytes naive_encode(const Pixels& pixels) {
  return packed(naive_nibbles(pixels));
}

/// What a stream holds, or nothing where it is not to the byte what the encoder would write.
std::optional<Pixels> naive_decode(const Bytes& bytes, std::size_t count) {
  if (bytes.size() % 4 != 0) return std::nullopt;
  std::size_t next = 0;
  const auto number = [&]() -> std::int64_t {
    std::int64_t value = 0;
    for (int k = 0;; ++k, ++next) {
      if (next >= 2 * bytes.size() || k > 9) return -1;
      const int byte = bytes[next / 8 * 4 + (3 - next % 8 / 2)];
      const int nibble = next % 2 == 0 ? byte >> 4 : byte & 15;
      value += static_cast<std::int64_t>(nibble % 8) << (3 * k);
      if (nibble < 8) break;
    }
    ++next;
    return value;
  };
  Pixels pixels;
  std::int64_t previous = 0;
  while (pixels.size() < count) {
    const std::size_t before = pixels.size();
    const std::int64_t zeros = number();
    if (zeros < 0 || zeros > static_cast<std::int64_t>(count - before)) return std::nullopt;
    pixels.insert(pixels.end(), static_cast<std::size_t>(zeros), 0);
    const std::int64_t others = number();
    if (others < 0 || others > static_cast<std::int64_t>(count - pixels.size())) return std::nullopt;
    for (std::int64_t i = 0; i < others; ++i) {
      const std::int64_t folded = number();
      if (folded < 0) return std::nullopt;
      previous += folded % 2 == 0 ? folded / 2 : -(folded + 1) / 2;
      if (previous < 1 || previous > 65535) return std::nullopt;
      pixels.push_back(static_cast<std::uint16_t>(previous));
    }
    if (pixels.size() == before) return std::nullopt;
  }
  if (naive_encode(pixels) != bytes) return std::nullopt;
  return pixels;
}

std::optional<Pixels> fast_decode(const Bytes& bytes, std::size_t count) {
  Pixels pixels(count);
  try {
    decode_rvl(bytes, pixels);
  } catch (const CorruptDepth&) {
    return std::nullopt;
  }
  return pixels;
}

void expect_round_trip(const Pixels& pixels) {
  Bytes code;
  encode_rvl(pixels, code);
  EXPECT_EQ(code, naive_encode(pixels));
  Pixels back(pixels.size(), 7);
  decode_rvl(code, back);
  EXPECT_EQ(back, pixels);

  encode_raw16(pixels, code);
  ASSERT_EQ(code.size(), 2 * pixels.size());
  back.assign(pixels.size(), 7);
  decode_raw16(code, back);
  EXPECT_EQ(back, pixels);
}

/// Pixels in runs, with neighbours `spread` apart.
Pixels random_pixels(std::mt19937& random, std::size_t count, int spread) {
  Pixels pixels;
  int value = 1000;
  while (pixels.size() < count) {
    std::size_t run = std::uniform_int_distribution<std::size_t>(1, 40)(random);
    const bool zero = random() % 2 == 0;
    for (; run > 0 && pixels.size() < count; --run) {
      value = std::clamp(value + std::uniform_int_distribution<int>(-spread, spread)(random), 1, 65535);
      pixels.push_back(zero ? std::uint16_t{0} : static_cast<std::uint16_t>(value));
    }
  }
  return pixels;
}

TEST(DepthCodec, ASmallImageIsCodedAsByHand) {
  // 1 zero and 3 others; 5, -1 and 10, folded to 10, 1 and 20; 1 zero and no others: nibbles 1 3 A1 1 C2 1 0
  const Pixels pixels{0, 5, 4, 14, 0};
  Bytes code;
  encode_rvl(pixels, code);
  EXPECT_EQ(code, (Bytes{0x21, 0x1C, 0xA1, 0x13, 0, 0, 0, 0}));
}

TEST(DepthCodec, ExtremeImagesComeBack) {
  expect_round_trip({});
  expect_round_trip({0});
  expect_round_trip({1});
  expect_round_trip({65535});
  expect_round_trip(Pixels(307200, 0));
  expect_round_trip(Pixels(307200, 65535));
  Pixels alternating(10001);
  for (std::size_t i = 0; i < alternating.size(); ++i) alternating[i] = i % 2 == 0 ? 65535 : 1;
  expect_round_trip(alternating);
  for (std::size_t i = 0; i < alternating.size(); ++i) alternating[i] = i % 2 == 0 ? 0 : 65535;
  expect_round_trip(alternating);
}

TEST(DepthCodec, EveryDifferenceComesBack) {
  Pixels pixels;
  for (int value = 1; value <= 65535; ++value) {
    pixels.push_back(1);
    pixels.push_back(static_cast<std::uint16_t>(value));
  }
  expect_round_trip(pixels);
}

TEST(DepthCodec, TheLargestImageComesBack) {
  Pixels pixels(kMostDepthPixels, 0);
  Bytes code;
  encode_rvl(pixels, code);
  EXPECT_EQ(code.size(), 8U);  // 8 nibbles, and one for no others
  Pixels back(pixels.size(), 7);
  decode_rvl(code, back);
  EXPECT_EQ(back, pixels);
  pixels.push_back(0);
  EXPECT_THROW(encode_rvl(pixels, code), std::length_error);
}

class DepthCodecSeeds : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Random, DepthCodecSeeds, testing::Range(0U, 20U));

TEST_P(DepthCodecSeeds, RandomImagesComeBack) {
  std::mt19937 random(GetParam());
  for (const int spread : {1, 3, 20, 200, 2000, 60000})
    expect_round_trip(
        random_pixels(random, std::uniform_int_distribution<std::size_t>(1, 3000)(random), spread));
}

TEST_P(DepthCodecSeeds, DamagedCodeIsRefusedExactlyWhereTheOracleRefusesIt) {
  std::mt19937 random(GetParam());
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pixels pixels = random_pixels(random, 1 + random() % 100, i % 2 == 0 ? 2 : 500);
    Bytes code = naive_encode(pixels);
    const std::size_t at = random() % code.size();
    switch (random() % 5) {
      case 0:
        code[at] = static_cast<std::uint8_t>(random());
        break;
      case 1:
        code[at] ^= static_cast<std::uint8_t>(1U << (random() % 8));
        break;
      case 2:
        code.resize(at);
        break;
      case 3:
        code.insert(code.end(), {0, 0, 0, static_cast<std::uint8_t>(random() % 2)});
        break;
      default:
        std::generate(code.begin(), code.end(), [&] { return static_cast<std::uint8_t>(random()); });
    }
    const auto expected = naive_decode(code, pixels.size());
    ASSERT_EQ(fast_decode(code, pixels.size()), expected);
    ++(expected ? accepted : refused);
  }
  EXPECT_GT(accepted, 0);
  EXPECT_GT(refused, 0);
}

void expect_refused(const Nibbles& nibbles, std::size_t count, const std::string& why) {
  Pixels pixels(count);
  try {
    decode_rvl(packed(nibbles), pixels);
    ADD_FAILURE() << "accepted instead of: " << why;
  } catch (const CorruptDepth& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(DepthCodec, CorruptCodeIsRefusedWithItsCause) {
  expect_refused({}, 1, "ends in the middle");
  expect_refused({0, 0}, 1, "empty run");                                // would go on for ever
  expect_refused({1, 1, 2, 0, 1, 0, 0, 0}, 3, "empty run");              // 1 zero, 1 other, no zero, 1 other
  expect_refused({2, 0}, 1, "more pixels");                              // zeros
  expect_refused({0, 2, 2, 0}, 1, "more pixels");                        // others
  expect_refused({0, 1, 0}, 1, "range");                                 // a 0 among the others
  expect_refused({0, 1, 1}, 1, "range");                                 // -1
  expect_refused({0, 1, 0x8, 0x8, 0x8, 0x8, 0x8, 4, 0, 0}, 1, "range");  // 65536
  expect_refused({0, 1, 2, 0, 0, 0, 0, 0xF}, 9, "empty run");
  expect_refused({0, 4, 2, 2, 2, 0xF, 0xF, 0xF}, 4, "in the middle");
  expect_refused(Nibbles(8, 0xF), 1, "too long");
  expect_refused(Nibbles(16, 0xF), 1, "too long");
  expect_refused({9, 8, 8, 8, 8, 8, 8, 8, 1, 0, 0, 0, 0, 0, 0, 0}, 1, "too long");
  expect_refused({9, 0, 0, 0, 0, 0, 0, 0}, 1, "padded");
  expect_refused({1, 0, 0, 0, 0, 0, 0, 1}, 1, "after its last pixel");
  expect_refused({1, 0, 0, 0, 0, 0, 0, 0, 0}, 1, "after its last pixel");
  expect_refused({0}, 0, "after its last pixel");
}

TEST(DepthCodec, RawOfAnotherSizeIsRefused) {
  Pixels pixels(3);
  for (const std::size_t size : {0U, 5U, 7U, 8U})
    EXPECT_THROW(decode_raw16(Bytes(size), pixels), CorruptDepth);
}

/// Every tenth depth image of a folder of the recordings.
class DepthCodecRecordings : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Real, DepthCodecRecordings, testing::Values("tum_fr1_rpy", "pepper_floor"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(DepthCodecRecordings, RealImagesComeBackAtHalfTheirSizeOrLess) {
  const std::filesystem::path folder = real_data(GetParam()) / "depth";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recording in " << folder;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 100U);
  std::size_t raw_bytes = 0;
  std::size_t code_bytes = 0;
  for (std::size_t i = 0; i < files.size(); i += 10) {
    const cv::Mat image = cv::imread(files[i].string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(image.type(), CV_16UC1) << files[i];
    const Pixels pixels(image.begin<std::uint16_t>(), image.end<std::uint16_t>());
    expect_round_trip(pixels);
    Bytes code;
    encode_rvl(pixels, code);
    raw_bytes += 2 * pixels.size();
    code_bytes += code.size();
  }
  RecordProperty("bytes_of_raw_percent", static_cast<int>(100 * code_bytes / raw_bytes));
  EXPECT_LT(code_bytes, raw_bytes / 2);
}

}  // namespace
}  // namespace floornav
