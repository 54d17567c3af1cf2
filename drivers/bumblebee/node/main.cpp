#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include "drivers/bumblebee/node/bumblebee_capture.hpp"
#include "drivers/bumblebee/node/bumblebee_node.hpp"
#include "drivers/bumblebee/node/firewire_camera.hpp"
#include "perception/settings.hpp"
#include "runtime/process/daemon.hpp"

namespace floornav {
namespace {

constexpr const char* kName = "floornav-bumblebee";

/// The sections of the robot's file that the driver reads: of perception's, where anything is looked for.
struct BumblebeeProgramSettings {
  BumblebeeSettings bumblebee;
  PerceptionSettings perception;
};

template <class Visitor>
void visit_settings(Visitor& visit, BumblebeeProgramSettings& s) {
  visit("bumblebee", s.bumblebee);
  visit("perception", s.perception);
}

struct BumblebeeOptions {
  std::string camera;
  bool gave_up = false;
};

void say(const std::string& line) {
  fmt::print(stderr, "{}: {}\n", kName, line);
}

/// Prints what is on the bus and ends the program.
void list_cameras() {
  FirewireCamera library{BumblebeeSettings{}};
  const std::vector<std::string> cameras = library.list();
  for (const std::string& line : cameras) fmt::print("{}\n", line);
  if (cameras.empty()) fmt::print("{}\n", library.absence());
  throw CLI::Success();
}

/// Prints what the first camera stores of its calibration and ends the program.
void print_calibration() {
  FirewireCamera camera{BumblebeeSettings{}};
  try {
    fmt::print("{}", camera.stored_calibration());
  } catch (const DeviceError& error) {
    say(error.what());
    throw CLI::RuntimeError(EXIT_FAILURE);
  }
  throw CLI::Success();
}

void add_options(CLI::App& app, BumblebeeOptions& options) {
  app.add_option("--camera", options.camera, "GUID, 16 hexadecimal digits; before the one of the file")
      ->type_name("GUID");
  app.add_flag_callback("--list", list_cameras, "tell which cameras are on the bus and end");
  app.add_flag_callback("--print-calibration", print_calibration,
                        "print the calibration that the first camera stores and end");
}

MatchedRegion region_of(const RoiSettings& roi) {
  return {roi.x_min_m, roi.x_max_m, roi.y_min_m, roi.y_max_m, roi.z_min_m, roi.z_max_m};
}

std::unique_ptr<Node> make_node(const BumblebeeProgramSettings& all, Parallel& parallel,
                                BumblebeeOptions& options) {
  cv::setNumThreads(1);  // the pool's threads are the daemon's own
  BumblebeeSettings settings = all.bumblebee;
  if (!options.camera.empty()) settings.camera = options.camera;
  auto source = capture_bumblebee(settings, std::make_unique<FirewireCamera>(settings), say);
  return std::make_unique<BumblebeeNode>(
      settings, region_of(all.perception.roi), std::move(source), parallel, [&options] {
        say("libdc1394 hangs: this process ends, so that a new one can begin");
        options.gave_up = true;
        std::raise(SIGTERM);
      });
}

int run(int argc, const char* const* argv) {
  BumblebeeOptions options;
  const DaemonInfo info{kName, "Streams and matches a Bumblebee2 or XB3 on FireWire: BUMBLEBEE_CLOUD out.",
                        [&](CLI::App& app) { add_options(app, options); }};
  const int code = run_daemon<BumblebeeProgramSettings>(
      argc, argv, info, [&](const BumblebeeProgramSettings& settings, Parallel& parallel) {
        return make_node(settings, parallel, options);
      });
  return options.gave_up ? EXIT_FAILURE : code;
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  const int code = floornav::run(argc, argv);
  std::fflush(nullptr);
  std::quick_exit(code);  // a thread that hangs in libdc1394 must not meet the library's destructors
}
