// virtual-kinect: runs programs with a Kinect that is none, and commands it.
#include <csignal>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "lcmtypes/channels.hpp"
#include "runtime/process/lcm_transport.hpp"
#include "runtime/process/stop_signals.hpp"
#include "tests/devices/kinect/log_scene.hpp"
#include "tests/devices/kinect/room_scene.hpp"
#include "tests/devices/kinect/virtual_kinect.hpp"
#include "tests/devices/live/child_program.hpp"
#include "tests/devices/live/robot.hpp"

namespace floornav {
namespace {

struct RunOptions {
  std::string log;
  std::string control = "virtual-kinect.control";
  int max_frames = 400;
  int transfer_ms = 33;
  double seconds = 0;
  LiveTask drive;
  std::vector<std::string> command;
};

LiveCamera live_camera(VirtualKinect& kinect, const LogScene& scene) {
  LiveCamera camera;
  camera.source = "kinect";
  camera.channel = channel::kKinectCloud;
  camera.period_us = scene.period_us;
  camera.origin_us = kinect->origin_us;
  camera.unplug = [&kinect] { kinect.unplug(); };
  camera.plug = [&kinect] { kinect.plug(); };
  camera.stall = [&kinect] { kinect->stalled = 1; };
  camera.raised_us = [&kinect](std::int64_t step) {
    return kinect->records[static_cast<std::size_t>(step) % ControlBlock::kRecords].raised_us.load();
  };
  camera.body_at = [&scene](std::int64_t since_first_us) { return scene.body_at(since_first_us); };
  return camera;
}

int run(const RunOptions& options) {
  const std::string scene_file = options.control + ".scene";
  LogScene scene;
  if (options.log.empty())
    write_room_scene({}, scene_file);
  else
    scene = write_log_scene(options.log, scene_file, options.max_frames);
  VirtualKinect kinect(options.control, scene_file);
  kinect->transfer_us = options.transfer_ms * 1000;
  const std::atomic<bool>& stop = stop_on_signals();
  const pid_t child = start_program(
      options.command, {{"LD_LIBRARY_PATH", FLOORNAV_VIRTUAL_OPENNI2},
                        {kControlVariable, std::filesystem::absolute(options.control).string()}});
  int code = 0;
  if (options.drive.seconds > 0) {
    LiveTask task = options.drive;
    task.lcm_url = lcm_url(task.lcm_url);
    const LiveReport report = drive_live(live_camera(kinect, scene), task, stop);
    fmt::print("{}{}\n", report.text,
               report.flaw.empty() ? "all frames came through" : "FLAW: " + report.flaw);
    code = report.flaw.empty() ? 0 : 1;
    ::kill(child, SIGTERM);
  }
  const int child_code = wait_for_program(child, options.seconds, stop);
  std::filesystem::remove(scene_file);
  std::filesystem::remove(options.control);
  return code != 0 ? code : child_code;
}

const std::map<std::string, std::function<void(VirtualKinect&, int)>>& commands() {
  static const std::map<std::string, std::function<void(VirtualKinect&, int)>> kCommands = {
      {"unplug", [](VirtualKinect& k, int device) { k.unplug(device); }},
      {"plug", [](VirtualKinect& k, int device) { k.plug(device); }},
      {"unplug-in-frame", [](VirtualKinect& k, int) { k->unplug_in_frame = 1; }},
      {"stall", [](VirtualKinect& k, int on) { k->stalled = on; }},
      {"drop", [](VirtualKinect& k, int frames) { k->drop = frames; }},
      {"cut-short", [](VirtualKinect& k, int frames) { k->cut_short = frames; }},
      {"wrong-size", [](VirtualKinect& k, int frames) { k->wrong_size = frames; }},
      {"garbage", [](VirtualKinect& k, int frames) { k->garbage = frames; }},
      {"black", [](VirtualKinect& k, int on) { k->black = on; }},
      {"hang", [](VirtualKinect& k, int on) { k->stop_hangs = on; }},
      {"freeze", [](VirtualKinect& k, int on) { k->frozen = on; }},
  };
  return kCommands;
}

void add_run(CLI::App& app, RunOptions& options, int& code) {
  CLI::App* sub = app.add_subcommand("run", "Run COMMAND with a virtual Kinect plugged in");
  sub->add_option("--log", options.log, "log whose KINECT_CLOUD it sees, there and back; default: a room");
  sub->add_option("--control", options.control, "file by which it is commanded")->capture_default_str();
  sub->add_option("--frames", options.max_frames, "at most so many of the log")->capture_default_str();
  sub->add_option("--transfer-ms", options.transfer_ms, "from exposure to arrival")->capture_default_str();
  sub->add_option("--seconds", options.seconds, "end COMMAND after so long");
  sub->add_option("--drive", options.drive.seconds,
                  "be the robot's base for so many seconds too: POSE and GOAL out; then end and report");
  sub->add_option("--unplug-at", options.drive.unplug_at_s,
                  "unplug the camera after so many seconds of --drive, for 2.5 s");
  sub->add_option("--may-lose", options.drive.may_lose, "frames that --drive forgives")
      ->capture_default_str();
  sub->add_option("--goal", options.drive.goal_m, "m, local frame")->delimiter(',')->capture_default_str();
  sub->add_option("--lcm-url", options.drive.lcm_url, "bus of --drive");
  sub->add_option("COMMAND", options.command, "after --")->required();
  sub->callback([&] { code = run(options); });
}

void add_command(CLI::App& app, std::string& control, std::string& what, int& number) {
  CLI::App* sub = app.add_subcommand("command", "Command a virtual Kinect that is being run");
  std::vector<std::string> names;
  for (const auto& [name, function] : commands()) names.push_back(name);
  sub->add_option("CONTROL", control, "control file of the run")->required();
  sub->add_option("WHAT", what)->required()->check(CLI::IsMember(names));
  sub->add_option("NUMBER", number, "of the device, of frames, or 1 for on and 0 for off");
  sub->callback([&] {
    VirtualKinect kinect(control);
    commands().at(what)(kinect, number);
  });
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  CLI::App app("A Kinect that is none, for the unmodified OpenNI2", "virtual-kinect");
  app.require_subcommand(1);
  floornav::RunOptions options;
  std::string control;
  std::string what;
  int number = 0;
  int code = 0;
  floornav::add_run(app, options, code);
  floornav::add_command(app, control, what, number);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "virtual-kinect: {}\n", error.what());
    return 1;
  }
  return code;
}
