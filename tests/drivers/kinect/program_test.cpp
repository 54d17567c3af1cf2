// The program as a person runs it, with the virtual Kinect.
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "drivers/kinect/node/openni_device.hpp"
#include "floornav/depth_cloud_t.hpp"
#include "lcmtypes/channels.hpp"
#include "runtime/process/log_reader.hpp"
#include "tests/tools/run_program.hpp"

namespace floornav {
namespace {

class KinectProgram : public testing::Test {
 protected:
  KinectProgram() { write_file(folder / "robot.yaml", ""); }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  /// floornav-kinect beside a virtual Kinect, ended after some seconds.
  [[nodiscard]] Outcome run(const std::vector<std::string>& arguments, const std::string& seconds) const {
    std::vector<std::string> words = {
        "virtual-kinect", "run",   "--control", path("control"),
        "--seconds",      seconds, "--",        FLOORNAV_PROGRAMS "/floornav-kinect"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_program(words);
  }
  const TemporaryFolder folder;
};

TEST_F(KinectProgram, ListsWhatIsPluggedIn) {
  const Outcome outcome = run({"--list"}, "20");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("virtual-kinect://0"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("serial number VK0000"), std::string::npos) << outcome.out;
}

TEST_F(KinectProgram, RecordsAnLcmLogAndAnOniFile) {
  const Outcome outcome = run({"--config", path("robot.yaml"), "--lcm-url", "memq://", "--record",
                               path("run.lcm"), "--record-oni", path("run.oni")},
                              "4");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  LogReader log(folder / "run.lcm");
  LogEvent event;
  std::set<std::string> channels;
  depth_cloud_t cloud;
  int clouds = 0;
  while (log.next(event)) {
    channels.insert(event.channel);
    const int size = static_cast<int>(event.bytes.size());
    if (event.channel == channel::kKinectCloud && cloud.decode(event.bytes.data(), 0, size) == size) ++clouds;
  }
  EXPECT_EQ(channels, (std::set<std::string>{channel::kHealth, channel::kKinectCloud}));
  EXPECT_GT(clouds, 10);
  EXPECT_EQ(log.skipped_bytes(), 0);

  KinectSettings settings;
  settings.device = path("run.oni");
  OpenNiDevice recording(settings, {Playback::kByHand, ""});
  recording.open();
  EXPECT_GT(recording.frames_in_file(), 10);
}

TEST_F(KinectProgram, TheBenchMeasuresWhateverOpenNiOpens) {
  const Outcome outcome =
      run_program({"virtual-kinect", "run", "--control", path("control"), "--seconds", "100", "--",
                   FLOORNAV_PROGRAMS "/floornav-bench", "driver", "--frames", "30", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json measured = nlohmann::json::parse(outcome.out);
  EXPECT_GE(measured.at("frames"), 30);
  EXPECT_TRUE(measured.at("cpu_ms").is_number());
  EXPECT_GT(measured.at("p99_ms"), 0);
  EXPECT_LT(measured.at("strips").at("near_ms"), measured.at("strips").at("whole_ms"));
}

TEST_F(KinectProgram, ARecordingThatIsNotThereIsTold) {
  const Outcome outcome =
      run({"--config", path("robot.yaml"), "--lcm-url", "memq://", "--device", path("nowhere.oni")}, "3");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("nowhere.oni: no such file"), std::string::npos) << outcome.err;
}

TEST_F(KinectProgram, ASettingThatCannotBeIsOneLine) {
  write_file(folder / "robot.yaml", "kinect: {depth_unit_um: 100000}\n");
  const Outcome outcome = run({"--config", path("robot.yaml"), "--lcm-url", "memq://"}, "20");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.lines_of_err(), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("depth_unit_um"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace floornav
