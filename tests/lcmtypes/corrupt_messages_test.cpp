// Messages that lcm-gen's own decode dies of, over-reads or swallows: each is an error here, and allocates
// next to nothing.

#include <limits>

#include <gtest/gtest.h>

#include "allocation_meter.hpp"
#include "sample_messages.hpp"
#include "wire_bytes.hpp"
#include "wire_test/byte_grid_t.hpp"
#include "wire_test/bytes_t.hpp"
#include "wire_test/counts_t.hpp"
#include "wire_test/element_grid_t.hpp"
#include "wire_test/elements_t.hpp"
#include "wire_test/fixed_t.hpp"
#include "wire_test/float_grid_t.hpp"
#include "wire_test/floats_t.hpp"
#include "wire_test/string_grid_t.hpp"
#include "wire_test/strings_t.hpp"

namespace floornav {
namespace {

constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

/// No value in memory is more than 16 times its size on the wire (an empty string: 5 bytes, then 32).
std::size_t allowed_bytes(std::size_t message_bytes) {
  return 16 * message_bytes + 256;
}

template <class Message>
void expect_refused(const std::vector<std::uint8_t>& bytes) {
  Message message;
  take_allocated_bytes();
  const int result = message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  EXPECT_LE(take_allocated_bytes(), allowed_bytes(bytes.size()));
  EXPECT_LT(result, 0);
}

template <class Message>
class CorruptLine : public testing::Test {};
using Lines =
    testing::Types<wire_test::bytes_t, wire_test::floats_t, wire_test::strings_t, wire_test::elements_t>;
TYPED_TEST_SUITE(CorruptLine, Lines);

TYPED_TEST(CorruptLine, CountsThatTheBytesCannotHold) {
  for (const std::int32_t n :
       {-1, kLeast, kMost, kMost - 1, 0x20000000, 0x20000001, 0x40000000, 100'000'000, 1001}) {
    SCOPED_TRACE(n);
    expect_refused<TypeParam>(WireBytes(TypeParam::getHash()).i32(n));
    WireBytes with_more(TypeParam::getHash());
    with_more.i32(n);
    for (int i = 0; i < 125; ++i) with_more.i64(0);
    expect_refused<TypeParam>(with_more);
  }
}

TYPED_TEST(CorruptLine, CountOfZeroEmptiesAnObjectUsedBefore) {
  TypeParam message;
  message.n = 3;
  message.values.resize(3);
  TypeParam used;
  ASSERT_TRUE(decodes(used, encoded(message)));
  ASSERT_EQ(used.values.size(), 3U);
  ASSERT_TRUE(decodes(used, WireBytes(TypeParam::getHash()).i32(0)));
  EXPECT_TRUE(used.values.empty());
}

TYPED_TEST(CorruptLine, EncodeRefusesACountThatIsNotTheArraysSize) {
  TypeParam message;
  message.values.resize(3);
  for (const std::int32_t n : {-1, 0, 2, 4, 1000, kMost, kLeast}) {
    message.n = n;
    EXPECT_TRUE(encoded(message).empty()) << n;
    std::vector<std::uint8_t> roomy(10000);
    EXPECT_EQ(message.encode(roomy.data(), 0, 10000), -1) << n;
  }
  message.n = 3;
  EXPECT_FALSE(encoded(message).empty());
}

template <class Message>
class CorruptGrid : public testing::Test {};
using Grids = testing::Types<wire_test::byte_grid_t, wire_test::float_grid_t, wire_test::string_grid_t,
                             wire_test::element_grid_t>;
TYPED_TEST_SUITE(CorruptGrid, Grids);

TYPED_TEST(CorruptGrid, CountsThatTheBytesCannotHold) {
  const std::pair<std::int32_t, std::int32_t> sizes[] = {{100'000'000, 0}, {1, 0},
                                                         {kMost, 0},       {-1, 0},
                                                         {0, -1},          {-1, -1},
                                                         {kLeast, kLeast}, {1, -1},
                                                         {65536, 65536},   {kMost, 1},
                                                         {1, kMost},       {kMost, kMost},
                                                         {46341, 46341},   {1 << 16, 1 << 15},
                                                         {1, 1001}};
  for (const auto& [h, w] : sizes) {
    SCOPED_TRACE(testing::Message() << h << " x " << w);
    expect_refused<TypeParam>(WireBytes(TypeParam::getHash()).i32(h).i32(w));
    WireBytes with_more(TypeParam::getHash());
    with_more.i32(h).i32(w);
    for (int i = 0; i < 125; ++i) with_more.i64(0);
    expect_refused<TypeParam>(with_more);
  }
}

TYPED_TEST(CorruptGrid, NoRowsEmptyAnObjectUsedBefore) {
  TypeParam message;
  message.h = 2;
  message.w = 3;
  message.cells.assign(2, std::vector(3, typename decltype(message.cells)::value_type::value_type{}));
  TypeParam used;
  ASSERT_TRUE(decodes(used, encoded(message)));
  ASSERT_EQ(used.cells.size(), 2U);
  ASSERT_EQ(used.cells[1].size(), 3U);
  ASSERT_TRUE(decodes(used, WireBytes(TypeParam::getHash()).i32(0).i32(7)));
  EXPECT_TRUE(used.cells.empty());
}

TYPED_TEST(CorruptGrid, EncodeRefusesCountsThatAreNotTheArraysSizes) {
  TypeParam message;
  message.cells.assign(2, std::vector(3, typename decltype(message.cells)::value_type::value_type{}));
  message.h = 2;
  message.w = 3;
  EXPECT_FALSE(encoded(message).empty());
  message.w = 4;
  EXPECT_TRUE(encoded(message).empty());
  message.w = 3;
  message.h = 3;
  EXPECT_TRUE(encoded(message).empty());
  message.h = 2;
  message.cells[1].pop_back();
  EXPECT_TRUE(encoded(message).empty());
  message.cells.assign(2, {});
  message.w = 0;
  EXPECT_TRUE(encoded(message).empty()) << "rows without columns, which decode refuses";
}

TEST(CorruptMessage, CountsOfOtherWidths) {
  constexpr auto kMost64 = std::numeric_limits<std::int64_t>::max();
  using wire_test::counts_t;
  expect_refused<counts_t>(WireBytes(counts_t::getHash()).i8(1).i16(1).i64(kMost64));
  expect_refused<counts_t>(WireBytes(counts_t::getHash()).i8(1).i16(1).i64(std::int64_t{1} << 62));
  expect_refused<counts_t>(WireBytes(counts_t::getHash()).i8(127).i16(32767).i64(std::int64_t{1} << 42));
  expect_refused<counts_t>(WireBytes(counts_t::getHash()).i8(127).i16(32767).i64(0));
  expect_refused<counts_t>(WireBytes(counts_t::getHash()).i8(127).i16(0).i64(1));
  expect_refused<counts_t>(WireBytes(counts_t::getHash()).i8(-128).i16(-32768).i64(1));
}

TEST(CorruptMessage, StringsWithoutTheirEnd) {
  const std::int64_t hash = drop_t::getHash();
  for (const std::int32_t length : {0, -1, kLeast, kMost, kMost - 8, 100})
    expect_refused<drop_t>(WireBytes(hash).i32(length).i8('a').i8(0).i64(1));
  expect_refused<drop_t>(WireBytes(hash).i32(2).i8('a').i8('b').i64(1));
  expect_refused<drop_t>(WireBytes(hash).i32(3).i8('a').i8(0).i8(0).i64(1));
  drop_t drop;
  ASSERT_TRUE(decodes(drop, WireBytes(hash).i32(2).i8('a').i8(0).i64(1)));
  EXPECT_EQ(drop.cause, "a");
}

TEST(CorruptMessage, StringsWithoutTheirEndInArrays) {
  for (const std::int32_t length : {0, -1, kLeast, kMost, 100}) {
    expect_refused<wire_test::strings_t>(
        WireBytes(wire_test::strings_t::getHash()).i32(2).text("a").i32(length).i8('b').i8(0));
    expect_refused<wire_test::elements_t>(
        WireBytes(wire_test::elements_t::getHash()).i32(1).i16(0).i32(length).i8('b').i8(0));
    expect_refused<wire_test::string_grid_t>(
        WireBytes(wire_test::string_grid_t::getHash()).i32(1).i32(2).text("a").i32(length).i8('b').i8(0));
  }
}

TEST(CorruptMessage, NoRoomForAFingerprint) {
  drop_t drop;
  const std::vector<std::uint8_t> bytes = encoded(drop);
  for (int size = -8; size < 8; ++size) EXPECT_LT(drop.decode(bytes.data(), 0, size), 0) << size;
}

TEST(CorruptMessage, NulInAStringIsNotEncoded) {
  drop_t drop;
  drop.cause = std::string("a\0b", 3);
  std::vector<std::uint8_t> roomy(100);
  EXPECT_EQ(drop.encode(roomy.data(), 0, 100), -1);
}

TEST(CorruptMessage, CountsInsideElements) {
  for (const std::int16_t n : {std::int16_t{-1}, std::int16_t{32767}, std::int16_t{2}})
    expect_refused<wire_test::elements_t>(
        WireBytes(wire_test::elements_t::getHash()).i32(1).i16(n).f32(1).text("a"));
}

TEST(CorruptMessage, FixedDimensionsCountInTheBytes) {
  for (const std::int32_t n : {9, 100'000'000}) {
    WireBytes bytes(wire_test::fixed_t::getHash());
    for (int i = 0; i < 6; ++i) bytes.f64(0);
    bytes.text("").text("").i16(0).text("").i16(0).text("").i32(n);
    for (int i = 0; i < 17; ++i) bytes.f32(0);  // 2 rows of 9 would be 18
    expect_refused<wire_test::fixed_t>(bytes);
  }
}

TEST(CorruptMessage, CountOfZeroEmptiesRowsOfFixedNumber) {
  wire_test::fixed_t full;
  full.n = 1;
  full.rows_of_n = {{1}, {2}};
  full.n_of_rows = {{3, 4, 5}};
  full.n_of_names = {{"x", "y"}};
  full.pairs_of_n.assign(2, std::vector<wire_test::element_t>(1));
  wire_test::fixed_t none;
  none.rows_of_n.resize(2);
  none.pairs_of_n.resize(2);
  wire_test::fixed_t used;
  ASSERT_TRUE(decodes(used, encoded(full)));
  ASSERT_TRUE(decodes(used, encoded(none)));
  EXPECT_EQ(used.rows_of_n, none.rows_of_n);
  EXPECT_TRUE(used.n_of_rows.empty());
  EXPECT_EQ(used.pairs_of_n.size(), 2U);
  EXPECT_TRUE(used.pairs_of_n[0].empty());
}

}  // namespace
}  // namespace floornav
