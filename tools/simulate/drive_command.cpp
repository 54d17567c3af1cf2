#include "tools/simulate/drive_command.hpp"

#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "tools/simulator/drivable.hpp"
#include "tools/simulator/drive.hpp"
#include "tools/simulator/scene_file.hpp"
#include "tools/simulator/truth_file.hpp"

namespace floornav {
namespace {

struct DriveOptions {
  std::string scene;
  std::string log;
  std::string sensor = "kinect";
  int width = 0;
  int height = 0;
  double rate_hz = 0;
  double camera_height_m = 0.72;
  double camera_pitch_deg = 20.0;
  bool correlated = false;
  double distortion_px = 0;
  double truth_resolution_m = 0.05;
  DriveSettings settings;
};

constexpr int kBlockMatchingWindow_px = 9;

SensorSpec sensor_of(const DriveOptions& options) {
  SensorSpec model;
  if (options.sensor == "kinect")
    model = kinect(options.width > 0 ? options.width : 640);
  else if (options.sensor == "bumblebee")
    model = bumblebee(1280, options.width > 0 ? options.width : 1280);
  else
    model = bumblebee(640, options.width > 0 ? options.width : 640);
  if (options.height > 0 && options.height != model.camera.height)
    throw std::invalid_argument(fmt::format("--height {}: with a width of {} it is {}", options.height,
                                            model.camera.width, model.camera.height));
  if (options.rate_hz > 0) model.rate_hz = options.rate_hz;
  if (options.correlated) model.noise.correlation_px = kBlockMatchingWindow_px;
  model.noise.distortion_px = options.distortion_px;
  model.T_body_sensor = mounted(0.0, 0.0, options.camera_height_m, options.camera_pitch_deg);
  return model;
}

void run(DriveOptions& options) {
  const Scene scene = load_scene(options.scene);
  const RobotSettings robot;
  options.settings.sensor = sensor_of(options);
  LogWriter log(options.log);
  const DriveSummary drive = record_drive(scene, robot, options.settings, log);
  log.close();
  write_truth(options.log, scene, robot, options.settings, drive,
              truth_of(scene, robot, options.truth_resolution_m, drive.start.position_m));
  fmt::print("{}: {} frames of {} x {} and {} poses, {:.1f} s along {:.1f} m of '{}'\n", options.log,
             drive.frames, options.settings.sensor.camera.width, options.settings.sensor.camera.height,
             drive.poses, drive.seconds, drive.length_m, scene.name);
}

}  // namespace

void add_drive_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("drive", "Drive a robot through a scene and log what it sees, truth beside");
  const auto o = std::make_shared<DriveOptions>();
  command->add_option("--scene", o->scene, "Scene file")->required();
  command->add_option("-o,--output", o->log, "Log to write; LOG.truth.yaml and LOG.truth.csv come beside it")
      ->required();
  command->add_option("--sensor", o->sensor, "kinect, bumblebee (1280 x 960) or bumblebee-640")
      ->check(CLI::IsMember({"kinect", "bumblebee", "bumblebee-640"}))
      ->capture_default_str();
  command->add_option("--width", o->width, "Give every n-th pixel only: a divisor of the sensor's width");
  command->add_option("--height", o->height, "To be sure of it: follows from the width");
  command->add_option("--rate", o->rate_hz, "Frames a second; default: the sensor's")
      ->check(CLI::Range(0.1, 1000.0));
  command->add_option("--seconds", o->settings.seconds, "Default: to the end of the drive")
      ->check(CLI::Range(0.1, 36000.0));
  command->add_option("--seed", o->settings.seed, "Of every noise")->capture_default_str();
  command->add_option("--camera-height", o->camera_height_m, "m above the floor")
      ->check(CLI::Range(0.05, 3.0))
      ->capture_default_str();
  command->add_option("--camera-pitch", o->camera_pitch_deg, "deg down")
      ->check(CLI::Range(-60.0, 89.0))
      ->capture_default_str();
  command->add_flag("--correlated", o->correlated, "Noise alike within windows, as block matching makes it");
  command->add_option("--distortion", o->distortion_px, "Slow distortion, px of disparity")
      ->check(CLI::Range(0.0, 5.0));
  command->add_option("--pose-rate", o->settings.pose_rate_hz, "Poses a second")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  command->add_option("--pose-noise", o->settings.pose_noise.position_m, "m, 1 sigma")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--angle-noise", o->settings.pose_noise.angle_deg, "deg, 1 sigma")
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--drift", o->settings.pose_noise.drift_per_m, "m per m")->check(CLI::Range(-0.5, 0.5));
  command->add_option("--heading-drift", o->settings.pose_noise.drift_deg_per_m, "deg per sqrt(m)")
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--latency", o->settings.cloud_latency_s, "s from exposure to arrival")
      ->check(CLI::Range(0.0, 2.0));
  command->add_option("--truth-resolution", o->truth_resolution_m, "m, side of the truth's cells")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  command->callback([o] { run(*o); });
}

}  // namespace floornav
