// virtual-bumblebee: runs programs with a FireWire bus and a Bumblebee that are none, and commands it.
#include <csignal>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "drivers/bumblebee/camera_registers.hpp"
#include "lcmtypes/channels.hpp"
#include "runtime/process/lcm_transport.hpp"
#include "runtime/process/stop_signals.hpp"
#include "tests/devices/firewire/eye_drive.hpp"
#include "tests/devices/firewire/virtual_bumblebee.hpp"
#include "tests/devices/live/child_program.hpp"
#include "tests/devices/live/robot.hpp"

namespace floornav {
namespace {

struct RunOptions {
  std::string camera = "xb3";
  std::string scene;
  double scene_s = 4.0;
  double rate_hz = 0;
  std::string control = "virtual-bumblebee.control";
  double seconds = 0;
  LiveTask drive;
  std::vector<std::string> command;
};

/// Between frames, as the bus's packets of 125 us make it.
int period_us(const RunOptions& options) {
  const bool xb3 = options.camera == "xb3";
  const double rate_hz = options.rate_hz > 0 ? options.rate_hz : xb3 ? 7.5 : 15.0;
  const std::int64_t bytes = xb3 ? 1280 * 960 * 2 : 640 * 480 * 2;
  return static_cast<int>(transfer_us(bytes, packet_bytes_for(rate_hz, bytes, xb3 ? 800 : 400)));
}

LiveCamera live_camera(VirtualBumblebee& bumblebee, const EyeDrive& drive) {
  LiveCamera camera;
  camera.source = "bumblebee";
  camera.channel = channel::kBumblebeeCloud;
  camera.period_us = drive.period_us();
  camera.origin_us = bumblebee->origin_us;
  camera.unplug = [&bumblebee] { bumblebee.unplug(); };
  camera.plug = [&bumblebee] { bumblebee.plug(); };
  camera.stall = [&bumblebee] { bumblebee->stalled = 1; };
  camera.raised_us = [&bumblebee](std::int64_t step) {
    return bumblebee->records[static_cast<std::size_t>(step) % FirewireControl::kRecords].raised_us.load();
  };
  camera.body_at = [&drive](std::int64_t since_first_us) { return drive.body_at(since_first_us); };
  return camera;
}

int run(const RunOptions& options) {
  const std::string scene_file = options.control + ".eyes";
  const EyeDrive drive(options.scene, options.scene_s, period_us(options));
  drive.write(options.camera == "xb3" ? bumblebee_xb3_rig() : bumblebee2_rig(), scene_file);
  VirtualBumblebee bumblebee(options.control, scene_file);
  const std::atomic<bool>& stop = stop_on_signals();
  const pid_t child = start_program(
      options.command, {{"LD_PRELOAD", FLOORNAV_VIRTUAL_FIREWIRE_LIBRARY},
                        {kFirewireVariable, std::filesystem::absolute(options.control).string()}});
  int code = 0;
  if (options.drive.seconds > 0) {
    LiveTask task = options.drive;
    task.lcm_url = lcm_url(task.lcm_url);
    const LiveReport report = drive_live(live_camera(bumblebee, drive), task, stop);
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

const std::map<std::string, std::function<void(VirtualBumblebee&, int)>>& commands() {
  static const std::map<std::string, std::function<void(VirtualBumblebee&, int)>> kCommands = {
      {"unplug", [](VirtualBumblebee& b, int) { b.unplug(); }},
      {"plug", [](VirtualBumblebee& b, int) { b.plug(); }},
      {"stall", [](VirtualBumblebee& b, int on) { b->stalled = on; }},
      {"drop", [](VirtualBumblebee& b, int frames) { b->drop = frames; }},
      {"lose-packets", [](VirtualBumblebee& b, int) { b->lose_packets = 1; }},
      {"bus-reset", [](VirtualBumblebee& b, int) { ++b->bus_resets; }},
      {"black", [](VirtualBumblebee& b, int on) { b->black = on; }},
      {"freeze", [](VirtualBumblebee& b, int on) { b->frozen = on; }},
      {"hang", [](VirtualBumblebee& b, int on) { b->requests_hang = on; }},
  };
  return kCommands;
}

void add_run(CLI::App& app, RunOptions& options, int& code) {
  CLI::App* sub = app.add_subcommand("run", "Run COMMAND with a virtual Bumblebee on its bus");
  sub->add_option("--camera", options.camera, "xb3 (1280x960) or bb2 (640x480)")
      ->check(CLI::IsMember({"xb3", "bb2"}))
      ->capture_default_str();
  sub->add_option("--scene", options.scene, "scene file whose drive it sees, there and back")->required();
  sub->add_option("--scene-seconds", options.scene_s, "of the drive that are rendered")
      ->capture_default_str();
  sub->add_option("--rate", options.rate_hz,
                  "frames a second of the driver; default: the camera's usual ones");
  sub->add_option("--control", options.control, "file by which it is commanded")->capture_default_str();
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
  CLI::App* sub = app.add_subcommand("command", "Command a virtual Bumblebee that is being run");
  std::vector<std::string> names;
  for (const auto& [name, function] : commands()) names.push_back(name);
  sub->add_option("CONTROL", control, "control file of the run")->required();
  sub->add_option("WHAT", what)->required()->check(CLI::IsMember(names));
  sub->add_option("NUMBER", number, "of frames, or 1 for on and 0 for off");
  sub->callback([&] {
    VirtualBumblebee bumblebee(control);
    commands().at(what)(bumblebee, number);
  });
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  CLI::App app("A Bumblebee that is none, for the unmodified libdc1394", "virtual-bumblebee");
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
    fmt::print(stderr, "virtual-bumblebee: {}\n", error.what());
    return 1;
  }
  return code;
}
