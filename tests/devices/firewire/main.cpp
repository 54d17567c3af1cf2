// virtual-bumblebee: runs programs with a FireWire bus and a Bumblebee that are none, and commands it.
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "drivers/bumblebee/camera_registers.hpp"
#include "lcmtypes/channels.hpp"
#include "runtime/process/stop_signals.hpp"
#include "tests/devices/firewire/eye_drive.hpp"
#include "tests/devices/firewire/virtual_bumblebee.hpp"
#include "tests/devices/live/command_line.hpp"

namespace floornav {
namespace {

struct RunOptions {
  std::string camera = "xb3";
  std::string scene;
  double scene_s = 4.0;
  double rate_hz = 0;
  LiveRun live{"virtual-bumblebee.control"};
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
  const std::string scene_file = options.live.control + ".eyes";
  const EyeDrive drive(options.scene, options.scene_s, period_us(options));
  drive.write(options.camera == "xb3" ? bumblebee_xb3_rig() : bumblebee2_rig(), scene_file);
  VirtualBumblebee bumblebee(options.live.control, scene_file);
  const std::atomic<bool>& stop = stop_on_signals();
  const pid_t child = start_program(
      options.live.command, {{"LD_PRELOAD", FLOORNAV_VIRTUAL_FIREWIRE_LIBRARY},
                             {kFirewireVariable, std::filesystem::absolute(options.live.control).string()}});
  const int code = finish_run(options.live, child, live_camera(bumblebee, drive), stop);
  std::filesystem::remove(scene_file);
  std::filesystem::remove(options.live.control);
  return code;
}

const Commands<VirtualBumblebee>& commands() {
  static const Commands<VirtualBumblebee> kCommands = {
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
  add_live_options(*sub, options.live);
  sub->callback([&] { code = run(options); });
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  CLI::App app("A Bumblebee that is none, for the unmodified libdc1394", "virtual-bumblebee");
  app.require_subcommand(1);
  floornav::RunOptions options;
  floornav::CommandWords words;
  int code = 0;
  floornav::add_run(app, options, code);
  floornav::add_command(app, floornav::commands(), words);
  return floornav::parse(app, argc, argv, code);
}
