#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/run_program.hpp"

namespace floornav {
namespace {

TEST(Table1Command, PrintsTheRowsThatBenchmarksReadTheSameOnAnyNumberOfThreads) {
  const std::vector<std::string> words{"floornav-bench",
                                       "table1",
                                       "--sensor",
                                       "kinect",
                                       "--configurations",
                                       "1",
                                       "--step-poses",
                                       "0",
                                       "--trade-off-configurations",
                                       "0",
                                       "--json"};
  const Outcome once = run_program(words);
  ASSERT_EQ(once.exit_code, 0) << once.err;
  const auto result = nlohmann::json::parse(once.out);
  ASSERT_EQ(result["rows"].size(), 10U);  // four section grids and eq. (5), two noises
  for (const auto& row : result["rows"]) {
    EXPECT_EQ(row["sensor"], "kinect");
    EXPECT_GT(row["x_res"].get<int>() * row["y_res"].get<int>(), 0);
    EXPECT_GT(row["near"]["mean_cm"].get<double>() + row["far"]["mean_cm"].get<double>(), 0.0);
    EXPECT_LE(row["near"]["missed"].get<int>(), row["near"]["count"].get<int>());
  }
  EXPECT_TRUE(result["steps"].is_array());
  std::vector<std::string> alone = words;
  alone.insert(alone.end(), {"--threads", "1"});
  EXPECT_EQ(run_program(alone).out, once.out);
}

TEST(MappingCommand, PrintsEveryGoalTheSameOnAnyNumberOfThreads) {
  const std::vector<std::string> words{"floornav-bench",   "mapping", "--worlds",        "2", "--frames", "2",
                                       "--large",          "0",       "--street-frames", "4", "--walks",  "0",
                                       "--configurations", "0",       "--step-poses",    "0", "--json"};
  const Outcome once = run_program(words);
  ASSERT_EQ(once.exit_code, 0) << once.err;
  auto result = nlohmann::json::parse(once.out);
  EXPECT_GT(result["fuse_median_ms"].get<double>(), 0.0);
  EXPECT_LE(result["drivable_blocked"].get<double>(), 0.02);
  EXPECT_LE(result["height_shape_rms_cm"].get<double>(), 0.3);
  std::vector<std::string> alone = words;
  alone.insert(alone.end(), {"--threads", "1"});
  const auto again = nlohmann::json::parse(run_program(alone).out);
  for (const char* key : {"drivable_blocked", "undrivable_free", "unseen", "height_rms_cm"})
    EXPECT_EQ(again[key], result[key]) << key;
}

TEST(FigureCommand, WritesItsPictureAndRefusesOtherNumbers) {
  const TemporaryFolder folder;
  const Outcome drawn = run_program({"floornav-bench", "figure", "2", "--out", folder.path().string()});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_GT(std::filesystem::file_size(folder / "figure2.png"), 1000U);
  EXPECT_NE(run_program({"floornav-bench", "figure", "3", "--out", folder.path().string()}).exit_code, 0);
}

TEST(ClosedLoopCommand, RefusesAPictureOfSeveralWorldsInOneLine) {
  const Outcome outcome =
      run_program({"floornav-simulate", "closed-loop", "--worlds", "2", "--picture", "/nowhere/run.png"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.lines_of_err(), 1) << outcome.err;
}

}  // namespace
}  // namespace floornav
