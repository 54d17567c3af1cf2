// Real messages, damaged at random: none may be read outside its bytes, and none makes decode allocate
// wildly.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "allocation_meter.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "sample_messages.hpp"

namespace floornav {
namespace {

using Bytes = std::vector<std::uint8_t>;

int mutations_per_type() {
  return std::getenv("FLOORNAV_LONG") != nullptr ? 1'000'000 : 50'000;
}

std::array<Bytes, 16> whole_messages(const AnyMessage& type) {
  std::array<Bytes, 16> messages;
  for (std::uint32_t seed = 0; seed < messages.size(); ++seed) messages[seed] = type.sample(seed);
  return messages;
}

class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  /// One to three changes; the fingerprint stays, since without it nothing is decoded.
  Bytes mutate(Bytes bytes) {
    for (int changes = below(3) + 1; changes > 0; --changes) change(bytes);
    return bytes;
  }

 private:
  int below(std::size_t end) {
    return std::uniform_int_distribution<int>(0, static_cast<int>(end) - 1)(random_);
  }
  std::ptrdiff_t place(const Bytes& bytes) { return 8 + below(bytes.size() - 8 + 1); }

  void change(Bytes& bytes) {
    const std::ptrdiff_t at = place(bytes);
    const auto left = bytes.end() - (bytes.begin() + at);
    switch (below(5)) {
      case 0:  // a bit
        if (left > 0) bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1 << below(8));
        break;
      case 1:  // a number that a count or a length should never be
        if (left >= 4) {
          constexpr std::array<std::uint32_t, 10> kNumbers{
              0, 1, 0xFFFFFFFF, 0x80000000, 0x7FFFFFFF, 0x20000000, 0x40000000, 100'000'000, 255, 65536};
          const std::uint32_t number = kNumbers[static_cast<std::size_t>(below(kNumbers.size()))];
          for (int i = 0; i < 4; ++i)
            bytes[static_cast<std::size_t>(at + i)] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
        }
        break;
      case 2:  // the end is missing
        bytes.resize(static_cast<std::size_t>(at));
        break;
      case 3:  // a piece is missing
        bytes.erase(bytes.begin() + at, bytes.begin() + at + std::min<std::ptrdiff_t>(left, below(8) + 1));
        break;
      default:  // a piece is there twice
        const Bytes piece(bytes.begin() + at,
                          bytes.begin() + at + std::min<std::ptrdiff_t>(left, below(8) + 1));
        bytes.insert(bytes.begin() + at, piece.begin(), piece.end());
    }
  }

  std::mt19937 random_;
};

/// The type of that number in MessageTypes.
class Damaged : public testing::TestWithParam<std::size_t> {
 protected:
  AnyMessage& type() { return *types_[GetParam()]; }

 private:
  std::vector<std::unique_ptr<AnyMessage>> types_ = every_message_type();
};
INSTANTIATE_TEST_SUITE_P(EveryType, Damaged, testing::Range(std::size_t{0}, std::tuple_size_v<MessageTypes>),
                         [](const auto& info) { return every_message_type()[info.param]->name(); });

TEST(Messages, EveryDefinitionIsAmongThoseTested) {
  EXPECT_EQ(std::tuple_size_v<MessageTypes>, static_cast<std::size_t>(FLOORNAV_NUMBER_OF_TYPES));
}

TEST_P(Damaged, RoundTripIsExact) {
  for (const Bytes& bytes : whole_messages(type())) {
    ASSERT_GT(bytes.size(), 8U);
    ASSERT_EQ(type().decode(bytes), static_cast<int>(bytes.size()));
    EXPECT_EQ(type().encode(), bytes);
  }
}

TEST_P(Damaged, CutAnywhereOrTooLongIsRefused) {
  const Bytes bytes = type().sample(3);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_LT(type().decode(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))), 0)
        << size;
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_LT(type().decode(longer), 0);
}

TEST_P(Damaged, MutationsNeitherCrashNorAllocateWildly) {
  Mutator mutator(7);
  const auto whole = whole_messages(type());
  int accepted = 0;
  const int mutations = mutations_per_type();
  for (int i = 0; i < mutations; ++i) {
    const Bytes bytes = mutator.mutate(whole[static_cast<std::size_t>(i) % whole.size()]);
    take_allocated_bytes();
    const int result = type().decode(bytes);
    ASSERT_LE(take_allocated_bytes(), 16 * bytes.size() + 256);
    if (result < 0) continue;
    ++accepted;
    ASSERT_EQ(type().encode(), bytes) << "what decode accepts, encode writes again to the byte";
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, mutations);
}

TEST(DamagedCloud, UnpackingRefusesOrFillsEveryPixel) {
  Mutator mutator(11);
  const auto whole = whole_messages(*every_message_type()[0]);
  std::vector<std::uint16_t> pixels;
  int unpacked = 0;
  for (int i = 0; i < mutations_per_type(); ++i) {
    depth_cloud_t cloud;
    if (!decodes(cloud, mutator.mutate(whole[static_cast<std::size_t>(i) % whole.size()]))) continue;
    try {
      unpack_pixels(cloud, pixels);
    } catch (const CorruptDepth&) {
      continue;
    }
    ++unpacked;
    ASSERT_EQ(pixels.size(), static_cast<std::size_t>(cloud.width * cloud.rows));
  }
  EXPECT_GT(unpacked, 0);
}

}  // namespace
}  // namespace floornav
