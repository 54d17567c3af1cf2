#pragma once

#include <atomic>
#include <csignal>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "runtime/process/lcm_transport.hpp"
#include "tests/devices/live/child_program.hpp"
#include "tests/devices/live/robot.hpp"

namespace floornav {

/// What a program that runs others beside a virtual camera is told, whatever the camera.
struct LiveRun {
  explicit LiveRun(std::string control_file) : control(std::move(control_file)) {}

  std::string control;  ///< file by which the camera is commanded
  double seconds = 0;   ///< end the command after so long; 0: never
  LiveTask drive;
  std::vector<std::string> command;
};

inline void add_live_options(CLI::App& sub, LiveRun& run) {
  sub.add_option("--control", run.control, "file by which it is commanded")->capture_default_str();
  sub.add_option("--seconds", run.seconds, "end COMMAND after so long");
  sub.add_option("--drive", run.drive.seconds,
                 "be the robot's base for so many seconds too: POSE and GOAL out; then end and report");
  sub.add_option("--unplug-at", run.drive.unplug_at_s,
                 "unplug the camera after so many seconds of --drive, for 2.5 s");
  sub.add_option("--may-lose", run.drive.may_lose, "frames that --drive forgives")->capture_default_str();
  sub.add_option("--goal", run.drive.goal_m, "m, local frame")->delimiter(',')->capture_default_str();
  sub.add_option("--lcm-url", run.drive.lcm_url, "bus of --drive");
  sub.add_option("COMMAND", run.command, "after --")->required();
}

/// Drives if that is asked for, then waits for the program. Returns what the whole run ends with.
inline int finish_run(const LiveRun& run, pid_t child, const LiveCamera& camera,
                      const std::atomic<bool>& stop) {
  int code = 0;
  if (run.drive.seconds > 0) {
    LiveTask task = run.drive;
    task.lcm_url = lcm_url(task.lcm_url);
    const LiveReport report = drive_live(camera, task, stop);
    fmt::print("{}{}\n", report.text,
               report.flaw.empty() ? "all frames came through" : "FLAW: " + report.flaw);
    code = report.flaw.empty() ? 0 : 1;
    ::kill(child, SIGTERM);
  }
  const int child_code = wait_for_program(child, run.seconds, stop);
  return code != 0 ? code : child_code;
}

/// What a virtual camera can be commanded to do.
template <class Camera>
using Commands = std::map<std::string, std::function<void(Camera&, int)>>;

/// The words of one command.
struct CommandWords {
  std::string control;
  std::string what;
  int number = 0;
};

template <class Camera>
void add_command(CLI::App& app, const Commands<Camera>& commands, CommandWords& words) {
  CLI::App* sub = app.add_subcommand("command", "Command a virtual camera that is being run");
  std::vector<std::string> names;
  for (const auto& [name, function] : commands) names.push_back(name);
  sub->add_option("CONTROL", words.control, "control file of the run")->required();
  sub->add_option("WHAT", words.what)->required()->check(CLI::IsMember(names));
  sub->add_option("NUMBER", words.number, "of the device, of frames, or 1 for on and 0 for off");
  sub->callback([&commands, &words] {
    Camera camera(words.control);
    commands.at(words.what)(camera, words.number);
  });
}

/// Parses the command line, which runs what it asks for and leaves `code`.
inline int parse(CLI::App& app, int argc, char** argv, const int& code) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return 1;
  }
  return code;
}

}  // namespace floornav
