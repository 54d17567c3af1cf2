#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "floornav/grid_map_t.hpp"
#include "mapping/node/grid_map_message.hpp"
#include "runtime/process/log_reader.hpp"
#include "runtime/process/log_writer.hpp"
#include "tests/real/outputs.hpp"
#include "tests/tools/run_program.hpp"

namespace floornav {
namespace {

namespace fs = std::filesystem;

const fs::path kLog = fs::path(FLOORNAV_SOURCE_DIR) / "logs/furnished_room_160x120.lcm";

/// Every file under a folder with its content; summary.json without its times.
std::map<std::string, std::string> contents_under(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string content = file_content(entry.path());
    if (entry.path().filename() == "summary.json") {
      auto summary = nlohmann::json::parse(content);
      summary.erase("timing");
      content = summary.dump();
    }
    contents[fs::relative(entry.path(), folder).string()] = content;
  }
  return contents;
}

/// The first seconds of the project's log, so that a replay is short.
class ReplayCommand : public testing::Test {
 protected:
  void SetUp() override {
    LogReader whole(kLog);
    LogWriter part(short_log_);
    LogEvent event;
    std::int64_t first_us = 0;
    while (whole.next(event)) {
      if (first_us == 0) first_us = event.timestamp_us;
      if (event.timestamp_us - first_us > 6'000'000) break;
      part.write(event.timestamp_us, event.channel, event.bytes);
    }
    part.close();
  }
  [[nodiscard]] fs::path replay(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> words{"floornav-replay", short_log_, "--out", folder_ / name};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_program(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return folder_ / name;
  }
  void expect_refused(const std::vector<std::string>& words, const std::string& what) const {
    const Outcome outcome = run_program(words);
    EXPECT_GT(outcome.exit_code, 0) << what;
    EXPECT_EQ(outcome.lines_of_err(), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  TemporaryFolder folder_;
  const fs::path short_log_ = folder_ / "short.lcm";
};

TEST_F(ReplayCommand, WritesEveryOutputWithTheSameFrames) {
  const fs::path out = replay("out", {"--goal", "2,0.5"});
  for (const char* name : {"map.yaml", "map.pgm", "belief.tiff", "height.tiff", "map.png", "terrain.png",
                           "path.csv", "surfels.csv", "frames.csv", "summary.json", "result.lcm"})
    EXPECT_GT(fs::file_size(out / name), 10U) << name;
  const auto summary = nlohmann::json::parse(file_content(out / "summary.json"));
  const auto frames = read_csv(out / "frames.csv");
  const auto surfels = read_csv(out / "surfels.csv");
  EXPECT_GT(frames.size(), 5U);
  EXPECT_EQ(summary["frames"], frames.size());
  EXPECT_EQ(summary["surfels"], surfels.size());
  double points = 0;
  for (const Row& frame : frames) points += frame.at("points");
  EXPECT_EQ(summary["points"], points);
  EXPECT_EQ(summary["sections"]["processed"], 12 * frames.size());
  EXPECT_EQ(summary["sections"]["skipped"], 0);
  EXPECT_TRUE(summary["timing"].contains("perception"));
}

/// Whoever recorded the messages would draw the same map as the files show.
TEST_F(ReplayCommand, TellsInItsResultLogTheMapThatItsFilesShow) {
  const fs::path out = replay("out", {"--goal", "2,0.5"});
  LogReader result(out / "result.lcm");
  LogEvent event;
  GridMapReceiver receiver;
  std::set<std::string> channels;
  while (result.next(event)) {
    channels.insert(event.channel);
    if (event.channel != "GRID_MAP") continue;
    grid_map_t message{};
    ASSERT_GT(message.decode(event.bytes.data(), 0, static_cast<int>(event.bytes.size())), 0);
    receiver.apply(message);
  }
  EXPECT_EQ(channels, (std::set<std::string>{"GOAL", "GRID_MAP", "PATH", "SURFELS", "TERRAIN_MAP"}));
  const PublishedMap map(out);
  int known = 0;
  for (const auto& [tile, vertices] : receiver.map().tiles())
    for (int i = 0; i < GridTile::kVertices; ++i) {
      const VertexState state = vertices->state[static_cast<std::size_t>(i)];
      const Cell cell = map.at(
          {tile.ix * GridTile::kSide + i % GridTile::kSide, tile.iy * GridTile::kSide + i / GridTile::kSide});
      ASSERT_EQ(static_cast<int>(state), static_cast<int>(cell));
      known += state != VertexState::kUnknown ? 1 : 0;
    }
  EXPECT_GT(known, 500);
}

TEST_F(ReplayCommand, SkipsSectionsUnderADeadlineInWorkAlikeEveryTime) {
  const auto tight = contents_under(replay("tight", {"--deadline-ms", "0.5"}));
  const auto summary = nlohmann::json::parse(tight.at("summary.json"));
  EXPECT_GT(summary["sections"]["skipped"], 0);
  EXPECT_EQ(tight, contents_under(replay("again", {"--deadline-ms", "0.5", "--threads", "2"})));
}

TEST_F(ReplayCommand, RefusesAbsurdOptionsInOneLine) {
  const auto expect_option_refused = [&](const std::string& option, const std::string& value) {
    expect_refused({"floornav-replay", short_log_, "--out", folder_ / "out", option, value}, option);
  };
  expect_option_refused("--goal", "1");
  expect_option_refused("--goal", "1,nan");
  expect_option_refused("--goal", "a,b");
  expect_option_refused("--threads", "0");
  expect_option_refused("--deadline-ms", "-1");
  expect_refused({"floornav-replay", short_log_}, "--out");
  write_file(folder_ / "file", "");
  expect_refused({"floornav-replay", short_log_, "--out", folder_ / "file"}, "file");
}

}  // namespace
}  // namespace floornav
