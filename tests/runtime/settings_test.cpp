#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/process/settings_reader.hpp"
#include "runtime/process/settings_writer.hpp"
#include "tests/runtime/temporary_file.hpp"

namespace floornav {
namespace {

struct Mount {
  double height_m = 1.0;
};
template <class Visitor>
void visit_settings(Visitor& visit, Mount& s) {
  visit("height_m", s.height_m, Allowed{0.0, 3.0});
}

struct Sample {
  double x_max_m = 4.9;
  float threshold_m = 0.1F;
  int sections = 4;
  std::uint64_t seed = 1;
  bool strict = false;
  std::string search = "auto";
  std::string title = "none";
  Mount mount;
  std::vector<Mount> cameras;
  std::vector<double> angles_deg = {1.5};
};
template <class Visitor>
void visit_settings(Visitor& visit, Sample& s) {
  visit("x_max_m", s.x_max_m, Allowed{0.1, 20.0});
  visit("threshold_m", s.threshold_m, Allowed{0.0, 1.0});
  visit("sections", s.sections, Allowed{1, 64});
  visit("seed", s.seed);
  visit("strict", s.strict);
  visit("search", s.search, {"auto", "window"});
  visit("title", s.title);
  visit("mount", s.mount);
  visit("cameras", s.cameras);
  visit("angles_deg", s.angles_deg, Allowed{0.0, 90.0});
}

Sample read(const std::string& text) {
  const TemporaryFile file(text);
  Sample settings;
  read_settings(file.path(), settings);
  return settings;
}

TEST(SettingsReader, TakesEveryKindOfValue) {
  const Sample s = read(R"(
x_max_m: 3.5
threshold_m: 1e-2
sections: 8
seed: 18000000000
strict: true
search: window
title: "a: b"
mount: {height_m: 0.72}
cameras:
  - height_m: 0.1
  - {}
angles_deg: [0, 45.5]
)");
  EXPECT_EQ(s.x_max_m, 3.5);
  EXPECT_EQ(s.threshold_m, 0.01F);
  EXPECT_EQ(s.sections, 8);
  EXPECT_EQ(s.seed, 18'000'000'000U);
  EXPECT_TRUE(s.strict);
  EXPECT_EQ(s.search, "window");
  EXPECT_EQ(s.title, "a: b");
  EXPECT_EQ(s.mount.height_m, 0.72);
  ASSERT_EQ(s.cameras.size(), 2U);
  EXPECT_EQ(s.cameras[0].height_m, 0.1);
  EXPECT_EQ(s.cameras[1].height_m, 1.0);
  EXPECT_THAT(s.angles_deg, testing::ElementsAre(0.0, 45.5));
}

TEST(SettingsReader, KeepsTheDefaultOfAnAbsentKey) {
  for (const char* text : {"", "# nothing\n", "sections: 4\n", "mount:\n"}) {
    const Sample s = read(text);
    EXPECT_EQ(s.x_max_m, 4.9) << text;
    EXPECT_EQ(s.mount.height_m, 1.0) << text;
    EXPECT_THAT(s.angles_deg, testing::ElementsAre(1.5)) << text;
  }
}

struct BadFile {
  std::string name;
  std::string text;
  std::vector<std::string> told;  // parts of the one line, after the file's name
};

class SettingsReaderRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(SettingsReaderRefuses, InOneLineThatNamesAllOfIt) {
  const TemporaryFile file(GetParam().text);
  Sample settings;
  try {
    read_settings(file.path(), settings);
    FAIL() << "was taken: " << GetParam().text;
  } catch (const SettingsError& e) {
    const std::string line = e.what();
    EXPECT_THAT(line, testing::StartsWith(file.path().string() + ":"));
    EXPECT_THAT(line, testing::Not(testing::HasSubstr("\n")));
    for (const std::string& part : GetParam().told) EXPECT_THAT(line, testing::HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, SettingsReaderRefuses,
    testing::Values(
        BadFile{"WrongUnit", "\nx_max_cm: 350\n", {":2: x_max_cm: unknown key", "'x_max_m'"}},
        BadFile{"UnknownNested", "mount:\n  hight_m: 1\n", {":2: mount.hight_m: unknown key", "'height_m'"}},
        BadFile{"UnknownFarFromAll",
                "zzzzqqqqwwww: 1\n",
                {":1: zzzzqqqqwwww: unknown key", "known here:", "sections"}},
        BadFile{"UnknownInList", "cameras:\n  - {}\n  - high: 2\n", {":3: cameras[1].high: unknown key"}},
        BadFile{"TooLarge", "x_max_m: 20.1", {":1: x_max_m: must be 0.1 .. 20 ", "'20.1'"}},
        BadFile{"TooSmall", "sections: 0", {":1: sections: must be 1 .. 64", "'0'"}},
        BadFile{"NotANumber", "x_max_m: far", {"x_max_m: must be a number 0.1 .. 20", "'far'"}},
        BadFile{"NumberWithUnit", "x_max_m: 3.5m", {"x_max_m", "'3.5m'"}},
        BadFile{"NaN", "x_max_m: .nan", {"x_max_m", "'.nan'"}},
        BadFile{"PlainNan", "x_max_m: nan", {"x_max_m", "'nan'"}},
        BadFile{"Infinite", "x_max_m: .inf", {"x_max_m", "'.inf'"}},
        BadFile{"Overflow", "x_max_m: 1e999", {"x_max_m", "'1e999'"}},
        BadFile{"Fraction", "sections: 2.5", {"sections: must be a whole number 1 .. 64", "'2.5'"}},
        BadFile{"IntegerOverflow", "sections: 4294967297", {"sections", "'4294967297'"}},
        BadFile{"NegativeSeed", "seed: -1", {"seed", "'-1'"}},
        BadFile{"NotABool", "strict: 1", {"strict: must be true or false", "'1'"}},
        BadFile{"NotInList", "search: quick", {"search: must be one of: auto, window", "'quick'"}},
        BadFile{"MapForNumber", "x_max_m: {a: 1}", {"x_max_m: must be a number", "a map"}},
        BadFile{"NothingForNumber", "x_max_m:\n", {"x_max_m", "nothing"}},
        BadFile{"NumberForMap", "mount: 3", {"mount: must be a map", "'3'"}},
        BadFile{"NumberForList", "cameras: 3", {"cameras: must be a list", "'3'"}},
        BadFile{"ListItem", "angles_deg: [1, 91]", {"angles_deg[1]: must be 0 .. 90", "'91'"}},
        BadFile{"Twice", "sections: 4\nsections: 5\n", {":2: sections: stands twice"}},
        BadFile{
            "TwiceNested", "mount:\n  height_m: 1\n  height_m: 1\n", {":3: mount.height_m: stands twice"}},
        BadFile{"ListAtTop", "- 1\n- 2\n", {"the file: must be a map", "a list"}},
        BadFile{"WordAtTop", "hello\n", {"the file: must be a map", "'hello'"}},
        BadFile{"TwoDocuments", "sections: 4\n---\nsections: 5\n", {"more than one YAML document"}},
        BadFile{"NotYaml", "a: [1, 2\nb: }", {"not YAML"}},
        BadFile{"Tab", "mount:\n\theight_m: 1\n", {":2: not YAML"}},
        BadFile{"Binary", std::string("\x7f\x45\x4c\x46\x00\xff\xfe{[", 9), {}},
        BadFile{"DeepNesting", std::string(100'000, '['), {}}),
    [](const auto& info) { return info.param.name; });

TEST(SettingsReader, RefusesAFileThatIsNotThere) {
  Sample settings;
  EXPECT_THROW(read_settings("/nowhere/robot.yaml", settings), SettingsError);
  EXPECT_THROW(read_settings("/", settings), SettingsError);
}

struct Robot {
  Mount robot;
};
template <class Visitor>
void visit_settings(Visitor& visit, Robot& s) {
  visit("robot", s.robot);
}

TEST(RobotFile, LeavesTheOtherProgramsSectionsAlone) {
  const TemporaryFile file("robot: {height_m: 0.5}\nplanner: {anything: 1}\n");
  Robot robot;
  read_robot_file(file.path(), robot);
  EXPECT_EQ(robot.robot.height_m, 0.5);
}

TEST(RobotFile, RefusesASectionThatNobodyReads) {
  const TemporaryFile file("robot: {height_m: 0.5}\nplaner: {anything: 1}\n");
  Robot robot;
  try {
    read_robot_file(file.path(), robot);
    FAIL();
  } catch (const SettingsError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr(":2: planer: unknown key; did you mean 'planner'?"));
  }
}

TEST(SettingsWriter, WritesWhatTheReaderTakesBack) {
  Sample s;
  s.x_max_m = 1.0 / 3.0;
  s.threshold_m = 0.7F;
  s.strict = true;
  s.title = "a \"b\": \\ # c";
  s.cameras = {{0.25}, {0.5}};
  s.angles_deg = {};
  const std::string text = settings_text(s);
  EXPECT_EQ(settings_text(read(text)), text);
  EXPECT_EQ(read(text).x_max_m, s.x_max_m);
  EXPECT_EQ(read(text).title, s.title);
  EXPECT_EQ(read(text).cameras[1].height_m, 0.5);
  EXPECT_THAT(text, testing::HasSubstr("# 0.1 .. 20"));
}

TEST(SettingsHash, ChangesWithAnyValueAndOnlyThen) {
  const Sample defaults;
  Sample other;
  EXPECT_EQ(settings_hash(other), settings_hash(defaults));
  other.mount.height_m = 1.0000001;
  EXPECT_NE(settings_hash(other), settings_hash(defaults));
  EXPECT_EQ(hash_of(""), static_cast<std::int64_t>(0xcbf29ce484222325ULL));
  EXPECT_EQ(hash_of("a"), static_cast<std::int64_t>(0xaf63dc4c8601ec8cULL));  // published FNV-1a vector
}

}  // namespace
}  // namespace floornav
