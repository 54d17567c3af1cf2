#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "drivers/kinect/node/kinect_capture.hpp"
#include "drivers/kinect/node/kinect_node.hpp"
#include "drivers/kinect/node/openni_device.hpp"
#include "runtime/process/daemon.hpp"

namespace floornav {
namespace {

constexpr const char* kName = "floornav-kinect";

/// The section of the robot's file that the driver reads.
struct KinectProgramSettings {
  KinectSettings kinect;
};

template <class Visitor>
void visit_settings(Visitor& visit, KinectProgramSettings& s) {
  visit("kinect", s.kinect);
}

struct KinectOptions {
  std::string device;
  std::string record_oni;
  bool gave_up = false;
};

void say(const std::string& line) {
  fmt::print(stderr, "{}: {}\n", kName, line);
}

/// Prints what is plugged in and ends the program.
void list_devices() {
  OpenNiDevice library{KinectSettings{}};
  const std::vector<std::string> devices = OpenNiDevice::list();
  for (const std::string& line : devices) fmt::print("{}\n", line);
  if (devices.empty()) fmt::print("{}\n", library.absence());
  throw CLI::Success();
}

void add_options(CLI::App& app, KinectOptions& options) {
  app.add_option("--device", options.device, "URI, serial number or .oni file; before the one of the file")
      ->type_name("DEVICE");
  app.add_option("--record-oni", options.record_oni,
                 "record depth to an .oni file too (takes a whole processor)")
      ->type_name("FILE");
  app.add_flag_callback("--list", list_devices, "tell which devices OpenNI2 sees and end");
}

std::unique_ptr<Node> make_node(KinectSettings settings, KinectOptions& options) {
  if (!options.device.empty()) settings.device = options.device;
  auto device =
      std::make_unique<OpenNiDevice>(settings, OpenNiOptions{Playback::kInRealTime, options.record_oni});
  auto capture = std::make_unique<KinectCapture>(std::move(device), periods_of(settings), say);
  return std::make_unique<KinectNode>(settings, std::move(capture), [&options] {
    say("OpenNI2 hangs: this process ends, so that a new one can begin");
    options.gave_up = true;
    std::raise(SIGTERM);
  });
}

int run(int argc, const char* const* argv) {
  KinectOptions options;
  const DaemonInfo info{kName, "Streams a Kinect, or any depth camera that OpenNI2 opens: KINECT_CLOUD out.",
                        [&](CLI::App& app) { add_options(app, options); }};
  const int code = run_daemon<KinectProgramSettings>(
      argc, argv, info,
      [&](const KinectProgramSettings& settings) { return make_node(settings.kinect, options); });
  return options.gave_up ? EXIT_FAILURE : code;
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  const int code = floornav::run(argc, argv);
  std::fflush(nullptr);
  std::quick_exit(code);  // a thread that hangs in OpenNI2 must not meet the library's destructors
}
