// virtual-kinect: runs programs with a Kinect that is none, and commands it.
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "lcmtypes/channels.hpp"
#include "runtime/process/stop_signals.hpp"
#include "tests/devices/kinect/log_scene.hpp"
#include "tests/devices/kinect/room_scene.hpp"
#include "tests/devices/kinect/virtual_kinect.hpp"
#include "tests/devices/live/command_line.hpp"

namespace floornav {
namespace {

struct RunOptions {
  std::string log;
  int max_frames = 400;
  int transfer_ms = 33;
  LiveRun live{"virtual-kinect.control"};
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
  const std::string scene_file = options.live.control + ".scene";
  LogScene scene;
  if (options.log.empty())
    write_room_scene({}, scene_file);
  else
    scene = write_log_scene(options.log, scene_file, options.max_frames);
  VirtualKinect kinect(options.live.control, scene_file);
  kinect->transfer_us = options.transfer_ms * 1000;
  const std::atomic<bool>& stop = stop_on_signals();
  const pid_t child = start_program(
      options.live.command, {{"LD_LIBRARY_PATH", FLOORNAV_VIRTUAL_OPENNI2},
                             {kControlVariable, std::filesystem::absolute(options.live.control).string()}});
  const int code = finish_run(options.live, child, live_camera(kinect, scene), stop);
  std::filesystem::remove(scene_file);
  std::filesystem::remove(options.live.control);
  return code;
}

const Commands<VirtualKinect>& commands() {
  static const Commands<VirtualKinect> kCommands = {
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
  sub->add_option("--frames", options.max_frames, "at most so many of the log")->capture_default_str();
  sub->add_option("--transfer-ms", options.transfer_ms, "from exposure to arrival")->capture_default_str();
  add_live_options(*sub, options.live);
  sub->callback([&] { code = run(options); });
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  CLI::App app("A Kinect that is none, for the unmodified OpenNI2", "virtual-kinect");
  app.require_subcommand(1);
  floornav::RunOptions options;
  floornav::CommandWords words;
  int code = 0;
  floornav::add_run(app, options, code);
  floornav::add_command(app, floornav::commands(), words);
  return floornav::parse(app, argc, argv, code);
}
