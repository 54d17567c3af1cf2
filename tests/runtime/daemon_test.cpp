#include "runtime/process/daemon.hpp"

#include <csignal>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/runtime/temporary_file.hpp"
#include "tests/runtime/toy_nodes.hpp"

namespace floornav {
namespace {

struct EchoSettings {
  double gain = 1.0;
};
template <class Visitor>
void visit_settings(Visitor& visit, EchoSettings& s) {
  visit("gain", s.gain, Allowed{0.0, 10.0});
}

struct Settings {
  EchoSettings robot;
};
template <class Visitor>
void visit_settings(Visitor& visit, Settings& s) {
  visit("robot", s.robot);
}

struct Outcome {
  int code = 0;
  std::string out;
  std::string err;
};

class CountingNode : public EchoNode {
 public:
  explicit CountingNode(bool& stopped) : EchoNode("echo", "IN", "OUT"), stopped_(stopped) {}
  void tick(Micros, Outbox&) override { std::raise(SIGTERM); }
  void stop(Micros, Outbox&) override { stopped_ = true; }

 private:
  bool& stopped_;
};

Outcome run(const std::vector<std::string>& arguments, bool* stopped = nullptr) {
  std::vector<const char*> argv = {"floornav-echo"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  bool ignored = false;
  bool& flag = stopped != nullptr ? *stopped : ignored;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.code =
      run_daemon<Settings>(static_cast<int>(argv.size()), argv.data(), {"floornav-echo", "Echoes IN on OUT."},
                           [&](const Settings&) { return std::make_unique<CountingNode>(flag); });
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

TEST(Daemon, EndsCleanlyOnSigterm) {
  const TemporaryFile config("robot: {gain: 2}\n");
  bool stopped = false;
  const Outcome outcome = run({"--config", config.path(), "--lcm-url", "memq://"}, &stopped);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(stopped);
  EXPECT_THAT(outcome.err, testing::HasSubstr("floornav-echo: running on memq://"));
}

TEST(Daemon, TellsAMistakeInOneLine) {
  const TemporaryFile wrong("robot: {gain: 11}\n");
  const TemporaryFile good("robot: {gain: 1}\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{}, "--config FILE"},
      {{"--config", "/nowhere.yaml"}, "/nowhere.yaml: no such file"},
      {{"--config", wrong.path()}, "robot.gain: must be 0 .. 10 (it is '11')"},
      {{"--config", good.path(), "--lcm-url", "nonsense"}, "is not an LCM URL"},
      {{"--confg", "x"}, "--confg"},
      {{"--config"}, "--config"},
      {{"--config", good.path(), "--threads", "2"}, "--threads"},  // one thread is all that it can use
  };
  for (const auto& [arguments, told] : mistakes) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << told;
    EXPECT_THAT(outcome.err, testing::StartsWith("floornav-echo: "));
    EXPECT_THAT(outcome.err, testing::HasSubstr(told));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(Daemon, PrintsItsSettingsAndItsHelp) {
  const TemporaryFile config("robot: {gain: 2}\n");
  EXPECT_THAT(run({"--print-config"}).out, testing::MatchesRegex("robot:\n  gain: 1 +# 0 .. 10\n"));
  EXPECT_THAT(run({"--config", config.path(), "--print-config"}).out, testing::HasSubstr("gain: 2"));
  EXPECT_THAT(run({"--help"}).out,
              testing::AllOf(testing::HasSubstr("Echoes IN on OUT."), testing::HasSubstr("Examples")));
  EXPECT_THAT(run({"--version"}).out, testing::HasSubstr("floornav-echo "));
  EXPECT_EQ(run({"--help"}).code, 0);
}

}  // namespace
}  // namespace floornav
