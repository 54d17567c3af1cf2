#include "tools/bench/mapping_command.hpp"

#include <memory>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "runtime/process/thread_pool.hpp"
#include "tools/bench/mapping_report.hpp"

namespace floornav {
namespace {

struct CommandOptions {
  MappingFigures figures;  ///< what is to be measured, and then what was
  StepOptions steps{.sensors = {SensorKind::kKinect}, .poses = 10, .plain_m2 = 200};
  std::uint64_t seed = 1001;
  double large_m2 = 100'000;
  int frames = 60;
  int threads = 2;
  bool json = false;
};

void run(CommandOptions& options) {
  constexpr double kSmall_m2 = 100;
  constexpr int kRepeats = 4;
  ThreadPool pool(options.threads);
  MappingFigures& f = options.figures;
  f.accuracy_options.seed = f.change_options.seed = f.gain_options.seed = options.steps.seed = options.seed;
  const std::vector<FloorEvidence> frames = kinect_evidence(options.frames);
  f.fuse = measure_fuse(frames, kRepeats);
  if (options.large_m2 > 0) f.sizes = measure_map_sizes(frames, {kSmall_m2, options.large_m2});
  if (f.accuracy_options.worlds > 0) f.accuracy = measure_map_accuracy(f.accuracy_options, pool);
  if (f.change_options.walks > 0) f.change = measure_map_change(f.change_options, pool);
  if (f.gain_options.configurations > 0) f.gain = measure_height_gain(f.gain_options, pool);
  if (options.steps.poses > 0) f.steps = measure_steps(options.steps, pool, [](int, int) {});
  if (options.json) {
    fmt::print("{}\n", json_of(f).dump());
  } else {
    print(f);
  }
}

}  // namespace

void add_mapping_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mapping", "Time, memory and truth of the map, against its goals");
  const auto o = std::make_shared<CommandOptions>();
  command
      ->add_option("--worlds", o->figures.accuracy_options.worlds, "Random worlds; 0: time and memory alone")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--frames", o->figures.accuracy_options.frames, "Frames in each world")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--walks", o->figures.change_options.walks, "People who walk through; 0: none")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command
      ->add_option("--configurations", o->figures.gain_options.configurations,
                   "Courses of Table 1 that are driven up to; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--step-poses", o->steps.poses, "Drives up to steps of each height; 0: none")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--street-frames", o->frames, "Frames that are timed")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command
      ->add_option("--pose-noise", o->figures.accuracy_options.pose_noise.position_m,
                   "m, 1 sigma of each axis")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--angle-noise", o->figures.accuracy_options.pose_noise.angle_deg,
                   "deg, 1 sigma of each axis")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--large", o->large_m2, "m2 of the large map; 0: no maps of other sizes")
      ->check(CLI::Range(0.0, 1e7))
      ->capture_default_str();
  command
      ->add_option(
          "--seed", o->seed,
          "Of the worlds and the noise. The printed figures are of 1001; what is tuned is tuned on seeds "
          "below 1000")
      ->capture_default_str();
  command->add_option("--threads", o->threads, "For the worlds; times are of one core")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", o->json, "For programs");
  command->callback([o] { run(*o); });
}

}  // namespace floornav
