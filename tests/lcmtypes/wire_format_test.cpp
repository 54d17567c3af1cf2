// The generated messages speak LCM's format: against bytes written by hand, and with bot_core's pose.

#include <gtest/gtest.h>

#include "bot_core/pose_t.hpp"
#include "sample_messages.hpp"
#include "wire_bytes.hpp"
#include "wire_test/counts_t.hpp"
#include "wire_test/fixed_t.hpp"
#include "wire_test/lines_t.hpp"
#include "wire_test/string_grid_t.hpp"

namespace floornav {
namespace {

using wire_test::element_t;

element_t element(std::vector<float> values, std::string label) {
  element_t e;
  e.n = static_cast<std::int16_t>(values.size());
  e.values = std::move(values);
  e.label = std::move(label);
  return e;
}

TEST(WireFormat, LinesOfEveryKindEncodeAsByHand) {
  wire_test::lines_t m;
  m.n = 2;
  m.bytes = {1, 255};
  m.flags = {0, 1};
  m.int8s = {-1, 5};
  m.int16s = {-2, 0x1234};
  m.int32s = {-3, 0x12345678};
  m.int64s = {-4, 0x123456789ABCDEF0};
  m.floats = {1.5F, -2.25F};
  m.doubles = {0.1, -1e300};
  m.strings = {"", "floor"};
  m.elements = {element({}, "a"), element({3, 4}, "")};

  const WireBytes by_hand = WireBytes(wire_test::lines_t::getHash())
                                .i32(2)
                                .i8(1)
                                .i8(-1)
                                .i8(0)
                                .i8(1)
                                .i8(-1)
                                .i8(5)
                                .i16(-2)
                                .i16(0x1234)
                                .i32(-3)
                                .i32(0x12345678)
                                .i64(-4)
                                .i64(0x123456789ABCDEF0)
                                .f32(1.5F)
                                .f32(-2.25F)
                                .f64(0.1)
                                .f64(-1e300)
                                .text("")
                                .text("floor")
                                .i16(0)
                                .text("a")
                                .i16(2)
                                .f32(3)
                                .f32(4)
                                .text("");
  EXPECT_EQ(encoded(m), static_cast<const std::vector<std::uint8_t>&>(by_hand));

  wire_test::lines_t back;
  ASSERT_TRUE(decodes(back, by_hand));
  EXPECT_EQ(back.int64s, m.int64s);
  EXPECT_EQ(back.doubles, m.doubles);
  EXPECT_EQ(back.strings, m.strings);
  EXPECT_EQ(back.elements[1].values, m.elements[1].values);
  EXPECT_EQ(back.elements[0].label, "a");
}

TEST(WireFormat, FixedDimensionsEncodeAsByHand) {
  wire_test::fixed_t m;
  m.matrix[1][2] = 6;
  m.names[0] = "left";
  m.pair[1] = element({7}, "p");
  m.n = 1;
  m.rows_of_n = {{10}, {11}};
  m.n_of_rows = {{12, 13, 14}};
  m.n_of_names = {{"x", "y"}};
  m.pairs_of_n = {{element({}, "q")}, {element({}, "r")}};
  m.last = element({}, "end");

  WireBytes by_hand(wire_test::fixed_t::getHash());
  by_hand.f64(0).f64(0).f64(0).f64(0).f64(0).f64(6).text("left").text("");
  by_hand.i16(0).text("").i16(1).f32(7).text("p").i32(1).f32(10).f32(11).f32(12).f32(13).f32(14);
  by_hand.text("x").text("y").i16(0).text("q").i16(0).text("r").i16(0).text("end");
  EXPECT_EQ(encoded(m), static_cast<const std::vector<std::uint8_t>&>(by_hand));

  wire_test::fixed_t back;
  ASSERT_TRUE(decodes(back, by_hand));
  EXPECT_EQ(back.matrix[1][2], 6);
  EXPECT_EQ(back.rows_of_n, m.rows_of_n);
  EXPECT_EQ(back.n_of_rows, m.n_of_rows);
  EXPECT_EQ(back.n_of_names, m.n_of_names);
  EXPECT_EQ(back.pairs_of_n[1][0].label, "r");
}

TEST(WireFormat, ThreeDimensionsWithCountsOfEveryWidth) {
  wire_test::counts_t m;
  m.a = 2;
  m.b = 1;
  m.c = 2;
  m.cube = {{{1, 2}}, {{3, 4}}};
  const WireBytes by_hand =
      WireBytes(wire_test::counts_t::getHash()).i8(2).i16(1).i64(2).f32(1).f32(2).f32(3).f32(4);
  EXPECT_EQ(encoded(m), static_cast<const std::vector<std::uint8_t>&>(by_hand));
  wire_test::counts_t back;
  ASSERT_TRUE(decodes(back, by_hand));
  EXPECT_EQ(back.cube, m.cube);
}

TEST(WireFormat, PoseIsBotCoresPose) {
  EXPECT_EQ(pose_t::getHash(), bot_core::pose_t::getHash());
  const pose_t ours = sample_message<pose_t>(1);
  bot_core::pose_t theirs;
  ASSERT_TRUE(decodes(theirs, encoded(ours)));
  EXPECT_EQ(theirs.utime, ours.utime);
  EXPECT_EQ(theirs.orientation[3], ours.orientation[3]);
  EXPECT_EQ(theirs.accel[2], ours.accel[2]);
}

TEST(WireFormat, NumbersOfANewMessageAreZero) {
  const wire_test::fixed_t fixed;
  EXPECT_EQ(fixed.n, 0);
  EXPECT_EQ(fixed.matrix[1][2], 0);
  const depth_cloud_t cloud;
  EXPECT_EQ(cloud.scale, 0);
  EXPECT_EQ(cloud.sensor_orientation[0], 0);
}

TEST(WireFormat, AnotherTypesMessageIsRefused) {
  goal_t goal;
  EXPECT_FALSE(decodes(goal, encoded(sample_message<map_request_t>(1))));
}

}  // namespace
}  // namespace floornav
