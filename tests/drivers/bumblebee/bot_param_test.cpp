#include "drivers/bumblebee/calibration/bot_param.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floornav {
namespace {

TEST(BotParam, HasBlocksValuesListsStringsAndComments) {
  const BotBlock file = parse_bot_param(
      "# a robot\n"
      "a = 1; cameras { left{ fx=320.5; name = \"one; {two}\"; # rest\n"
      "  t = [ -0.12, 0 , 1e-3,];} }\n");
  EXPECT_EQ(file.number("a"), 1);
  const BotBlock& left = file.blocks.at("cameras").blocks.at("left");
  EXPECT_EQ(left.number("fx"), 320.5);
  EXPECT_THAT(left.values.at("name"), testing::ElementsAre("one; {two}"));
  EXPECT_THAT(left.numbers("t", 3), testing::ElementsAre(-0.12, 0, 1e-3));
}

TEST(BotParam, SaysWhatANumberIsNot) {
  const BotBlock file = parse_bot_param("a = x; b = [1, 2];");
  EXPECT_THROW((void)file.number("a"), std::runtime_error);
  EXPECT_THROW((void)file.number("b"), std::runtime_error);
  EXPECT_THROW((void)file.number("c"), std::runtime_error);
}

class DamagedBotParam : public testing::TestWithParam<const char*> {};

TEST_P(DamagedBotParam, IsRefusedWithItsLine) {
  try {
    (void)parse_bot_param(GetParam());
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("line "));
  }
}

INSTANTIATE_TEST_SUITE_P(Texts, DamagedBotParam,
                         testing::Values("a", "a =", "a = 1", "a {", "a { b = 1;", "}", "= 1;", "a = [1, 2",
                                         "a = \"x", "a = 1; ]", "a { b { c { } }"));

}  // namespace
}  // namespace floornav
