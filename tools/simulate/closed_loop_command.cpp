#include "tools/simulate/closed_loop_command.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "runtime/process/thread_pool.hpp"
#include "tools/progress/progress.hpp"
#include "tools/simulate/closed_loop.hpp"
#include "tools/simulate/run_picture.hpp"

namespace floornav {
namespace {

constexpr double kRobotRadius_m = 0.52;  ///< the circle around PowerBot's rectangle
constexpr double kCameraHeight_m = 0.72;

struct ClosedLoopOptions {
  int worlds = 20;
  std::uint64_t seed = 1;
  double difficulty = 0.5;
  int width = 320;
  double camera_pitch_deg = 30.0;  ///< sees the floor from the robot's bumper on
  int threads = 2;
  bool exact_pose = false;
  bool json = false;
  int people = 0;
  std::string log;
  std::string picture;
  ClosedLoopSettings settings;
};

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kReached:
      return "reached";
    case Outcome::kStopped:
      return "stopped";
    default:
      return "collided";
  }
}

struct Tally {
  int reached = 0;
  int stopped = 0;
  int collided = 0;
  double length_ratio = 0;      ///< driven over shortest, median over the worlds reached
  double length_ratio_p95 = 0;  ///< the same, 95th percentile
  int replans = 0;              ///< in all
  double seconds = 0;           ///< in all, virtual
};

Tally tally_of(const std::vector<ClosedLoopResult>& results) {
  Tally tally;
  std::vector<double> ratios;
  for (const ClosedLoopResult& r : results) {
    tally.replans += r.replans;
    tally.seconds += r.seconds;
    if (r.outcome == Outcome::kStopped) ++tally.stopped;
    if (r.outcome == Outcome::kCollided) ++tally.collided;
    if (r.outcome != Outcome::kReached) continue;
    ++tally.reached;
    ratios.push_back(r.travelled_m / r.shortest_m);
  }
  if (ratios.empty()) return tally;
  std::sort(ratios.begin(), ratios.end());
  tally.length_ratio = ratios[ratios.size() / 2];
  tally.length_ratio_p95 = ratios[ratios.size() * 95 / 100];
  return tally;
}

std::vector<ClosedLoopResult> drive_all(const ClosedLoopOptions& options, const RobotSettings& robot) {
  std::vector<ClosedLoopResult> results(static_cast<std::size_t>(options.worlds));
  ThreadPool pool(options.threads);
  std::mutex mutex;
  int done = 0;
  Progress progress("worlds");
  pool.run(options.worlds, [&](int index, int) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(index);
    const RandomWorld world = random_world(seed, options.difficulty, options.people, robot);
    results[static_cast<std::size_t>(index)] = drive_world(world, robot, options.settings, seed, nullptr);
    const std::scoped_lock lock(mutex);
    progress.at(++done, options.worlds);
  });
  return results;
}

/// One world, with its log and its picture where they are asked for.
ClosedLoopResult drive_recorded(const ClosedLoopOptions& options, const RobotSettings& robot) {
  const RandomWorld world = random_world(options.seed, options.difficulty, options.people, robot);
  std::optional<LogWriter> log;
  if (!options.log.empty()) log.emplace(options.log);
  RunRecord record;
  record.log = log ? &*log : nullptr;
  const ClosedLoopResult result = drive_world(world, robot, options.settings, options.seed, &record);
  if (log) log->close();
  if (options.picture.empty()) return result;
  const std::string words =
      fmt::format("{} after {:.1f} s and {:.2f} m (shortest {:.2f} m): {}", name_of(result.outcome),
                  result.seconds, result.travelled_m, result.shortest_m, result.reason);
  write_run_picture(world, robot, record, words, options.picture);
  return result;
}

void print_text(const ClosedLoopOptions& options, const std::vector<ClosedLoopResult>& results) {
  fmt::print("{:<8}{:<10}{:>8}{:>10}{:>10}{:>8}  {}\n", "seed", "outcome", "s", "driven m", "short. m",
             "replans", "last word");
  for (std::size_t i = 0; i < results.size(); ++i) {
    const ClosedLoopResult& r = results[i];
    fmt::print("{:<8}{:<10}{:>8.1f}{:>10.2f}{:>10.2f}{:>8}  {} at {:.2f}, {:.2f}\n", options.seed + i,
               name_of(r.outcome), r.seconds, r.travelled_m, r.shortest_m, r.replans, r.reason, r.end_m.x(),
               r.end_m.y());
  }
  const Tally tally = tally_of(results);
  if (options.settings.known_map)
    fmt::print("The true map told at the start; difficulty {}\n", options.difficulty);
  else
    fmt::print("Kinect of {} px at {} Hz, {} deg down; difficulty {}, {} people a world\n", options.width,
               options.settings.sensor.rate_hz, options.camera_pitch_deg, options.difficulty, options.people);
  fmt::print("{} worlds: {} reached, {} stopped, {} collided; driven / shortest: median {:.2f}, p95 {:.2f}\n",
             results.size(), tally.reached, tally.stopped, tally.collided, tally.length_ratio,
             tally.length_ratio_p95);
}

void run(ClosedLoopOptions& options) {
  const bool recorded = !options.log.empty() || !options.picture.empty();
  if (recorded && options.worlds != 1)
    throw std::invalid_argument("--log and --picture are of one world: --worlds 1 --seed N");
  if (options.settings.known_map && options.people > 0)
    throw std::invalid_argument("--known-map knows nothing of --people");
  RobotSettings robot;
  robot.radius_m = kRobotRadius_m;
  options.settings.sensor = kinect(options.width);
  options.settings.sensor.rate_hz = 10.0;
  options.settings.sensor.T_body_sensor = mounted(0.0, 0.0, kCameraHeight_m, options.camera_pitch_deg);
  if (options.exact_pose) options.settings.pose_noise = {};
  const auto results = recorded ? std::vector{drive_recorded(options, robot)} : drive_all(options, robot);
  if (!options.json) {
    print_text(options, results);
    return;
  }
  const Tally tally = tally_of(results);
  const nlohmann::json line{{"worlds", options.worlds},
                            {"reached", tally.reached},
                            {"stopped", tally.stopped},
                            {"collided", tally.collided},
                            {"length_ratio", tally.length_ratio},
                            {"length_ratio_p95", tally.length_ratio_p95},
                            {"seed", options.seed},
                            {"width", options.width},
                            {"replans", tally.replans},
                            {"seconds", tally.seconds}};
  fmt::print("{}\n", line.dump());
}

}  // namespace

void add_closed_loop_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "closed-loop", "Perception, mapper and planner drive a PowerBot through random rooms, in virtual time");
  const auto o = std::make_shared<ClosedLoopOptions>();
  o->settings.pose_noise = {.position_m = 0.01, .angle_deg = 0.3};
  command->add_option("--worlds", o->worlds, "How many")->check(CLI::Range(1, 100000))->capture_default_str();
  command->add_option("--seed", o->seed, "Of the first world; the next ones follow")->capture_default_str();
  command->add_option("--difficulty", o->difficulty, "0 (wide) to 1 (crowded, steps, drops)")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--width", o->width, "Pixels of the Kinect's image that are rendered, a divisor of 640")
      ->capture_default_str();
  command->add_option("--camera-pitch", o->camera_pitch_deg, "deg down")
      ->check(CLI::Range(-60.0, 89.0))
      ->capture_default_str();
  command->add_option("--threads", o->threads, "Worlds at once")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--pose-noise", o->settings.pose_noise.position_m, "m, 1 sigma of each axis")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--angle-noise", o->settings.pose_noise.angle_deg, "deg, 1 sigma of each axis")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_flag("--exact-pose", o->exact_pose, "No noise of the pose");
  command->add_option("--people", o->people, "Who walk through each world; they wait for the robot")
      ->check(CLI::Range(0, 20))
      ->capture_default_str();
  command->add_flag("--known-map", o->settings.known_map,
                    "The planner is told the true map at the start: no camera, no perception, no mapper");
  command->add_option("--log", o->log, "Every message of the run, with --worlds 1");
  command->add_option("--picture", o->picture, "PNG of the run: its map over the truth, with --worlds 1");
  command->add_flag("--json", o->json, "For programs");
  command->callback([o] { run(*o); });
}

}  // namespace floornav
