#include "tools/bench/mapping_command.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "runtime/process/thread_pool.hpp"
#include "tools/bench/map_accuracy.hpp"
#include "tools/bench/map_change.hpp"
#include "tools/bench/map_cost.hpp"

namespace floornav {
namespace {

constexpr double kFuseGoal_ms = 2.0;
constexpr double kSlowerGoal = 1.2;
constexpr double kBytesGoal_per_m2 = 8000;
constexpr double kBlockedGoal = 0.01;
constexpr double kFreeGoal = 0.001;
constexpr double kHeightGoal_cm = 0.3;
constexpr double kTrailGoal = 0.01;
constexpr int kFramesGoal = 3;

struct CommandOptions {
  MapAccuracyOptions accuracy;
  MapChangeOptions change;
  double large_m2 = 100'000;
  int frames = 60;
  int threads = 2;
  bool json = false;
};

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}
double rms_cm(double square_m2, std::int64_t count) {
  return count > 0 ? 100.0 * std::sqrt(square_m2 / static_cast<double>(count)) : 0.0;
}

struct Figures {
  FuseCost fuse;
  std::vector<MapSizeCost> sizes;
  MapAccuracy accuracy;
  MapChange change;
};

const char* verdict(bool holds) {
  return holds ? "holds" : "short of it";
}

void print_costs(const Figures& f) {
  fmt::print("fuse a frame's {:.0f} cells   {:.2f} ms median, {:.2f} p99 (goal {}: {})\n", f.fuse.cells,
             f.fuse.fuse_median_ms, f.fuse.fuse_p99_ms, kFuseGoal_ms,
             verdict(f.fuse.fuse_median_ms <= kFuseGoal_ms));
  fmt::print("judge what changed         {:.2f} ms median, {:.2f} p99\n", f.fuse.refresh_median_ms,
             f.fuse.refresh_p99_ms);
  for (const MapSizeCost& size : f.sizes)
    fmt::print(
        "map of {:7.0f} m2          {:.2f} ms an update (mean {:.2f}), {:.0f} bytes a m2 (goal {}: {})\n",
        size.area_m2, size.update_median_ms, size.update_mean_ms, size.bytes_per_m2, kBytesGoal_per_m2,
        verdict(size.bytes_per_m2 <= kBytesGoal_per_m2));
  if (f.sizes.size() < 2) return;
  const double slower = f.sizes.back().update_mean_ms / f.sizes.front().update_mean_ms;
  fmt::print("largest against smallest   {:.2f} times the update's mean time (goal {}: {})\n", slower,
             kSlowerGoal, verdict(slower <= kSlowerGoal));
}

void print_accuracy(const MapAccuracyOptions& options, const MapAccuracy& a) {
  fmt::print("\n{} random worlds, {} frames, jitter {:.0f} mm and {:.1f} deg, cells within 3 m\n",
             options.worlds, options.frames, 1e3 * options.pose_noise.position_m,
             options.pose_noise.angle_deg);
  const double blocked = share(a.drivable_blocked, a.drivable);
  const double free = share(a.undrivable_free, a.undrivable);
  fmt::print(
      "drivable cells blocked     {:.2f} % of {} (goal {} %: {}); more than a cell from what is not drivable "
      "{:.2f} %\n",
      100 * blocked, a.drivable, 100 * kBlockedGoal, verdict(blocked <= kBlockedGoal),
      100 * share(a.drivable_inside_blocked, a.drivable_inside));
  fmt::print(
      "undrivable cells free      {:.2f} % of {} (goal {} %: {}); more than a cell from what is drivable "
      "{:.2f} %\n",
      100 * free, a.undrivable, 100 * kFreeGoal, verdict(free <= kFreeGoal),
      100 * share(a.undrivable_inside_free, a.undrivable_inside));
  fmt::print(
      "with a step on the border  {:.1f} % of {} free, their edges over it closed; with them {:.2f} %\n",
      100 * share(a.beside_step_free, a.beside_step), a.beside_step,
      100 * share(a.undrivable_free + a.beside_step_free, a.undrivable + a.beside_step));
  fmt::print("never seen                 {:.1f} % of the view\n", 100 * share(a.unseen, a.in_view));
  const double height_cm = rms_cm(a.square_m2, a.heights);
  fmt::print(
      "height RMS                 {:.2f} cm (goal {}: {}); {:.2f} cm without the mean error of the poses\n",
      height_cm, kHeightGoal_cm, verdict(height_cm <= kHeightGoal_cm), rms_cm(a.shape_square_m2, a.heights));
}

void print_change(const MapChangeOptions& options, const MapChange& c) {
  fmt::print("\n{} walks of a person through the view, then a box put down; the worst\n", options.walks);
  fmt::print("floor blocked 1 s after    {:.2f} % (mean {:.2f}; goal {} %: {})\n", 100 * c.trail,
             100 * c.trail_mean, 100 * kTrailGoal, verdict(c.trail <= kTrailGoal));
  fmt::print("a new box is in the map    after {} frames (goal {}: {})\n", c.frames_until_blocked,
             kFramesGoal, verdict(c.frames_until_blocked <= kFramesGoal));
  fmt::print("a standing box' cells lost {:.1f} %\n", 100 * c.eroded);
}

nlohmann::json json_of(const Figures& f) {
  nlohmann::json sizes = nlohmann::json::array();
  for (const MapSizeCost& size : f.sizes)
    sizes.push_back({{"area_m2", size.area_m2},
                     {"update_median_ms", size.update_median_ms},
                     {"update_mean_ms", size.update_mean_ms},
                     {"bytes_per_m2", size.bytes_per_m2}});
  const MapAccuracy& a = f.accuracy;
  return {{"fuse_median_ms", f.fuse.fuse_median_ms},
          {"fuse_p99_ms", f.fuse.fuse_p99_ms},
          {"refresh_median_ms", f.fuse.refresh_median_ms},
          {"sizes", sizes},
          {"drivable_blocked", share(a.drivable_blocked, a.drivable)},
          {"drivable_inside_blocked", share(a.drivable_inside_blocked, a.drivable_inside)},
          {"undrivable_free", share(a.undrivable_free, a.undrivable)},
          {"undrivable_inside_free", share(a.undrivable_inside_free, a.undrivable_inside)},
          {"unseen", share(a.unseen, a.in_view)},
          {"trail", f.change.trail},
          {"frames_until_blocked", f.change.frames_until_blocked},
          {"eroded", f.change.eroded},
          {"height_rms_cm", rms_cm(a.square_m2, a.heights)},
          {"height_shape_rms_cm", rms_cm(a.shape_square_m2, a.heights)}};
}

void run(CommandOptions& options) {
  constexpr double kSmall_m2 = 100;
  constexpr int kRepeats = 4;
  ThreadPool pool(options.threads);
  Figures figures;
  options.change.seed = options.accuracy.seed;
  const std::vector<FloorEvidence> frames = kinect_evidence(options.frames);
  figures.fuse = measure_fuse(frames, kRepeats);
  if (options.large_m2 > 0) figures.sizes = measure_map_sizes(frames, {kSmall_m2, options.large_m2});
  if (options.accuracy.worlds > 0) figures.accuracy = measure_map_accuracy(options.accuracy, pool);
  if (options.change.walks > 0) figures.change = measure_map_change(options.change, pool);
  if (options.json) {
    fmt::print("{}\n", json_of(figures).dump());
    return;
  }
  print_costs(figures);
  if (options.accuracy.worlds > 0) print_accuracy(options.accuracy, figures.accuracy);
  if (options.change.walks > 0) print_change(options.change, figures.change);
  fmt::print("\nsteps of 1 cm after ten frames, and heights as in Table 1: floornav-bench table1\n");
}

}  // namespace

void add_mapping_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("mapping", "Time, memory and truth of the map, against its goals");
  const auto o = std::make_shared<CommandOptions>();
  command->add_option("--worlds", o->accuracy.worlds, "Random worlds; 0: time and memory alone")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--frames", o->accuracy.frames, "Frames in each world")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--walks", o->change.walks, "People who walk through; 0: none")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--street-frames", o->frames, "Frames that are timed")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command->add_option("--pose-noise", o->accuracy.pose_noise.position_m, "m, 1 sigma of each axis")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--angle-noise", o->accuracy.pose_noise.angle_deg, "deg, 1 sigma of each axis")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--large", o->large_m2, "m2 of the large map; 0: no maps of other sizes")
      ->check(CLI::Range(0.0, 1e7))
      ->capture_default_str();
  command
      ->add_option("--seed", o->accuracy.seed, "Of the worlds and the noise; tune on others than you print")
      ->capture_default_str();
  command->add_option("--threads", o->threads, "For the worlds; times are of one core")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--json", o->json, "For programs");
  command->callback([o] { run(*o); });
}

}  // namespace floornav
