#include <atomic>
#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "runtime/process/stop_signals.hpp"
#include "tools/command_line/one_line_error.hpp"
#include "tools/import/import.hpp"
#include "tools/progress/progress.hpp"

namespace {

using namespace floornav;

/// The options that every sub-command has.
struct CommonOptions {
  std::string log;
  std::string sensor = "kinect";
  std::string intrinsics;
};

void add_common(CLI::App& command, CommonOptions& options, bool needs_intrinsics) {
  command.add_option("-o,--output", options.log, "The LCM log to write")->required()->type_name("LOG");
  command.add_option("--sensor", options.sensor, "Whose channel and noise model the clouds get")
      ->check(CLI::IsMember({"kinect", "bumblebee"}))
      ->capture_default_str();
  auto* const intrinsics =
      command.add_option("--intrinsics", options.intrinsics, "Of the depth camera, in pixels");
  intrinsics->type_name("fx,fy,cx,cy")->required(needs_intrinsics);
}

void add_mounting(CLI::App& command, FixedMounting& mounting) {
  command.add_option("--height", mounting.height_m, "Of the camera above the floor, m")
      ->required()
      ->check(CLI::Range(0.01, 10.0))
      ->type_name("H");
  command.add_option("--pitch", mounting.pitch_deg, "Of the camera, degrees, positive looks down")
      ->required()
      ->check(CLI::Range(-90.0, 90.0))
      ->type_name("P");
  command
      .add_option("--roll", mounting.roll_deg,
                  "Of the camera, degrees, positive: its left side is the lower one")
      ->required()
      ->check(CLI::Range(-180.0, 180.0))
      ->type_name("R");
  command
      .add_option(
          "--spacing", mounting.spacing_m,
          "Between the frames' places in the local frame, m: more than the region of interest is long")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str()
      ->type_name("M");
}

void add_depth_scale(CLI::App& command, double& counts_per_m) {
  command.add_option("--depth-scale", counts_per_m, "Counts of a pixel per metre")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str()
      ->type_name("S");
}

void tell(const ImportReport& report, const CommonOptions& options) {
  for (const auto& note : report.notes) fmt::print("{}\n", note);
  fmt::print("{}: {} clouds and {} poses of {:.1f} s\n", options.log, report.clouds, report.poses,
             static_cast<double>(report.span_us) / 1e6);
}

void run(const CommonOptions& options, const std::function<ImportReport(const ImportTarget&)>& import) {
  const std::atomic<bool>& stop_asked = stop_on_signals();
  Progress progress("frames");
  const ImportTarget target{options.log, imported_sensor(options.sensor),
                            [&](std::int64_t done, std::int64_t total) {
                              if (stop_asked) throw std::runtime_error("interrupted, nothing written");
                              progress.at(done, total);
                            }};
  tell(import(target), options);
}

/// Of the depth camera of a Kinect v1, by its field of view.
constexpr const char* kKinectIntrinsics = "575.8,575.8,319.5,239.5";

constexpr const char* kTumExample = R"(
A body on the plane z = floor-z stands under the camera and has its heading. The times of clouds and
poses are the recording's own.

Example:
  floornav-import tum rgbd_dataset_freiburg1_rpy -o rpy.lcm --intrinsics 517.3,516.5,318.6,255.3 --depth-scale 5000)";

constexpr const char* kDepthExample = R"(
Nothing is known of where the robot was, so each frame makes a map of its own: frame k stands at
x = spacing (k mod 10), y = -spacing (k div 10) in the local frame, 0.1 s after the one before.
floornav-replay --frame-pictures draws every frame beside its map.

Example:
  floornav-import depth pepper/depth -o pepper.lcm --intrinsics 381.4,381.4,321.7,236.9 --depth-scale 1000 \
                  --height 0.63 --pitch 20 --roll -11)";

constexpr const char* kPcdExample = R"(
Takes organised clouds (ascii, binary, binary_compressed) in the sensor's frame: x right, y down, z forward.
Without --intrinsics the camera is found from each cloud; one whose points are not on a pinhole camera's rays
is refused. Frames are placed as by "depth".

Example:
  floornav-import pcd five_people.pcd office1.pcd -o pcl.lcm --height 1.29 --pitch 4.7 --roll 0)";

constexpr const char* kLcmExample = R"(
Reads kinect.frame_msg_t as the kinect-lcm drivers sent it: depth in mm or 11-bit shift, plain or zlib. A POSE in the
log (bot_core.pose_t) is taken for the body's; without one each frame is placed as by "depth".

Example:
  floornav-import lcm lcmlog-2012-10-03.00 -o stairs.lcm --height 0.8 --pitch 15 --roll 0)";

constexpr const char* kOniExample = R"(
A recording of OpenNI2 (NiViewer2, floornav-kinect --record-oni). Frames are placed as by "depth".

Example:
  floornav-import oni test.oni -o test.lcm --height 1.0 --pitch 10 --roll 0)";

constexpr const char* kStereoExample = R"(
The raw images of LEFT and RIGHT go in pairs by name, else by order. The calibration is OpenCV's YAML (as
floornav-calibrate writes it), libbot's BotParam with --block, or two sensor.yaml of a EuRoC data set. Height, pitch
and roll are the real left camera's. Frames are placed as by "depth".

Example:
  floornav-import stereo cam0 cam1 -o room.lcm --calibration cam0_sensor.yaml,cam1_sensor.yaml \
                  --height 0.95 --pitch 22.8 --roll 0)";

void add_tum(CLI::App& app, CommonOptions& common, TumImport& what) {
  CLI::App& command = *app.add_subcommand("tum", "A TUM RGB-D folder: depth.txt and groundtruth.txt");
  command.add_option("DIR", what.folder, "The folder")->required();
  add_common(command, common, true);
  add_depth_scale(command, what.counts_per_m);
  command.add_option("--floor-z", what.floor_z_m, "Height of the floor in the ground truth's world, m")
      ->check(CLI::Range(-100.0, 100.0))
      ->capture_default_str()
      ->type_name("Z");
  command.footer(kTumExample);
  command.callback([&] {
    what.camera = parse_intrinsics(common.intrinsics);
    run(common, [&](const ImportTarget& target) { return import_tum(what, target); });
  });
}

void add_depth(CLI::App& app, CommonOptions& common, DepthImport& what) {
  CLI::App& command = *app.add_subcommand("depth", "Folders of 16-bit depth images without poses");
  command.add_option("DIR", what.folders, "The folders; their images are taken by name")->required();
  add_common(command, common, true);
  add_depth_scale(command, what.counts_per_m);
  add_mounting(command, what.mounting);
  command.footer(kDepthExample);
  command.callback([&] {
    what.camera = parse_intrinsics(common.intrinsics);
    run(common, [&](const ImportTarget& target) { return import_depth(what, target); });
  });
}

void add_pcd(CLI::App& app, CommonOptions& common, PcdImport& what) {
  CLI::App& command = *app.add_subcommand("pcd", "Organised .pcd clouds without poses");
  command.add_option("FILE", what.files, "The clouds, in this order")->required();
  add_common(command, common, false);
  add_mounting(command, what.mounting);
  command.footer(kPcdExample);
  command.callback([&] {
    if (!common.intrinsics.empty()) what.camera = parse_intrinsics(common.intrinsics);
    run(common, [&](const ImportTarget& target) { return import_pcd(what, target); });
  });
}

void add_lcm(CLI::App& app, CommonOptions& common, LcmImport& what) {
  CLI::App& command = *app.add_subcommand("lcm", "A log of kinect.frame_msg_t, the LCM world's older Kinect");
  command.add_option("LOG", what.log, "The log")->required();
  command.add_option("--channel", what.channel, "Of the frames")->capture_default_str();
  add_common(command, common, false);
  add_mounting(command, what.mounting);
  command.footer(kLcmExample);
  command.callback([&] {
    what.camera = parse_intrinsics(common.intrinsics.empty() ? kKinectIntrinsics : common.intrinsics);
    run(common, [&](const ImportTarget& target) { return import_lcm(what, target); });
  });
}

void add_oni(CLI::App& app, CommonOptions& common, OniImport& what) {
  CLI::App& command = *app.add_subcommand("oni", "A recording of OpenNI2 without poses");
  command.add_option("FILE", what.file, "The .oni file")->required();
  add_common(command, common, false);
  add_mounting(command, what.mounting);
  command.footer(kOniExample);
  command.callback([&] {
    if (!common.intrinsics.empty()) what.camera = parse_intrinsics(common.intrinsics);
    run(common, [&](const ImportTarget& target) { return import_oni(what, target); });
  });
}

void add_stereo(CLI::App& app, CommonOptions& common, StereoImport& what) {
  CLI::App& command =
      *app.add_subcommand("stereo", "Folders of raw stereo pairs without poses: matched here");
  command.add_option("LEFT", what.left, "Folder of the left images")->required();
  command.add_option("RIGHT", what.right, "Folder of the right images")->required();
  command.add_option("--calibration", what.calibration, "Of the pair of cameras")
      ->required()
      ->type_name("FILE");
  command.add_option("--block", what.calibration_block, "The stereo camera's name in a BotParam file");
  command.add_option("--matcher", what.matching.matcher, "At which size pairs are matched first, or how")
      ->check(CLI::IsMember({"auto", "half", "quarter", "sgbm", "block"}))
      ->capture_default_str();
  command.add_option("--nearest", what.matching.nearest_m, "Nearest distance that is matched, m")
      ->check(CLI::Range(0.1, 10.0))
      ->capture_default_str();
  command.add_option("-o,--output", common.log, "The LCM log to write")->required()->type_name("LOG");
  add_mounting(command, what.mounting);
  command.footer(kStereoExample);
  command.callback([&] {
    common.sensor = "bumblebee";
    run(common, [&](const ImportTarget& target) { return import_stereo(what, target); });
  });
}

int run_program(int argc, char** argv) {
  CLI::App app("Makes an LCM log of depth clouds and poses from recordings in other forms");
  app.name("floornav-import");
  app.require_subcommand(1);
  tell_errors_in_one_line(app);
  app.footer("Sub-commands have their own --help with examples.");
  CommonOptions common;
  TumImport tum;
  DepthImport depth;
  PcdImport pcd;
  LcmImport lcm;
  OniImport oni;
  StereoImport stereo;
  add_tum(app, common, tum);
  add_depth(app, common, depth);
  add_pcd(app, common, pcd);
  add_lcm(app, common, lcm);
  add_oni(app, common, oni);
  add_stereo(app, common, stereo);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "floornav-import: {}\n", error.what());
    return 1;
  }
}
