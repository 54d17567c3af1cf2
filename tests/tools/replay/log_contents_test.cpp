#include "tools/replay/log_contents.hpp"

#include <gtest/gtest.h>

#include "runtime/process/log_writer.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace floornav {
namespace {

class LogFile : public testing::Test {
 protected:
  void write(const std::vector<std::string>& channels) {
    LogWriter log(file_);
    std::int64_t time_us = 1'000'000;
    for (const auto& channel : channels)
      log.write(time_us += 1000, channel, std::vector<std::uint8_t>(50, 7));
    log.close();
  }
  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "log.lcm";
};

TEST_F(LogFile, IsCountedByChannel) {
  write({"POSE", "KINECT_CLOUD", "POSE", "BUMBLEBEE_CLOUD"});
  const LogContents contents = contents_of(file_);
  EXPECT_EQ(contents.events, 4);
  EXPECT_EQ(contents.clouds, 2);
  EXPECT_EQ(contents.channels.at("POSE"), 2);
  EXPECT_EQ(contents.last_us - contents.first_us, 3000);
  EXPECT_NO_THROW(require_replayable(contents, file_, false));
}

TEST_F(LogFile, WithoutOurCloudsIsRefusedByName) {
  write({"LASER", "SLAM_POSE"});
  try {
    require_replayable(contents_of(file_), file_, true);
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("LASER, SLAM_POSE"), std::string::npos);
  }
}

TEST_F(LogFile, CutAnywhereInItsLastEventIsRefusedUnlessSalvaged) {
  write({"KINECT_CLOUD", "POSE"});
  const std::string whole = file_content(file_);
  write({"KINECT_CLOUD"});
  const std::size_t first = file_content(file_).size();
  for (std::size_t length = first + 1; length < whole.size(); ++length) {
    write_file(file_, whole.substr(0, length));
    const LogContents contents = contents_of(file_);
    EXPECT_THROW(require_replayable(contents, file_, false), std::exception) << length;
    EXPECT_NO_THROW(require_replayable(contents, file_, true)) << length;
  }
}

}  // namespace
}  // namespace floornav
