#include "tools/bench/perception_command.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perception/node/perception_node.hpp"
#include "perception/node/surfels_message.hpp"
#include "runtime/process/settings_reader.hpp"
#include "runtime/process/thread_pool.hpp"
#include "tools/bench/cpu_clock.hpp"
#include "tools/bench/perception_frames.hpp"

namespace floornav {
namespace {

using Clock = std::chrono::steady_clock;

struct PerceptionOptions {
  std::filesystem::path log;
  std::string sensor = "kinect";
  std::filesystem::path config;
  int threads = 2;
  int repeats = 3;
  int level = 0;
  bool json = false;
};

/// The sections of the robot's file that perception reads.
struct BenchSettings {
  RobotSettings robot;
  PerceptionSettings perception;
};

template <class Visitor>
void visit_settings(Visitor& visit, BenchSettings& s) {
  visit("robot", s.robot);
  visit("perception", s.perception);
}

/// Wall time and CPU time of all threads, ms.
struct Times {
  double wall_ms = 0;
  double cpu_ms = 0;
};

Times now() {
  timespec cpu{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  return {std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count(),
          1e3 * static_cast<double>(cpu.tv_sec) + 1e-6 * static_cast<double>(cpu.tv_nsec)};
}

constexpr std::array<const char*, 6> kStageNames{"decode", "roi", "outliers", "planes", "cells", "messages"};

struct Measured {
  std::int64_t points = 0;
  std::vector<double> wall_ms, cpu_ms, near_first_ms;
  std::array<std::vector<double>, kStageNames.size()> stages;  ///< CPU time of all threads
};

/// One frame from the cloud's bytes to the messages.
void measure(FloorPerception& perception, FramePixels& memory, const TimedFrame& timed, Parallel& parallel,
             Measured& measured) {
  const Times begin = now();
  std::array<double, kStageNames.size()> spent{};
  Times last = begin;
  const auto end_stage = [&](std::size_t stage) {
    const Times at = now();
    spent[stage] += at.cpu_ms - last.cpu_ms;
    last = at;
  };
  const DepthFrame frame = unpack_frame(timed.strips, memory);
  end_stage(0);
  const double decoded_ms = last.wall_ms;
  const depth_cloud_t& first = timed.strips.front();
  FrameMessages messages({first.source, first.session, first.frame, first.sensor});
  const FloorEvidence& evidence = perception.process(
      frame, timed.T_world_body, parallel, [](std::int64_t) { return true; },
      [&](PerceptionStage stage) { end_stage(1 + static_cast<std::size_t>(stage)); },
      [&](const FloorEvidence& near_row) {
        messages.next(near_row, false);
        end_stage(5);
        measured.near_first_ms.push_back(last.wall_ms - decoded_ms);
      });
  messages.next(evidence, true);
  end_stage(5);
  measured.points += evidence.pixels.in_roi;
  measured.wall_ms.push_back(last.wall_ms - begin.wall_ms);
  measured.cpu_ms.push_back(last.cpu_ms - begin.cpu_ms);
  for (std::size_t s = 0; s < spent.size(); ++s) measured.stages[s].push_back(spent[s]);
}

/// One way to run perception; all ways take turns frame by frame, so that the machine's other work meets all.
class Contestant {
 public:
  Contestant(const BenchSettings& settings, const SectionSettings& sections, int threads, int level)
      : sections_(sections), pool_(threads), perception_(with(settings, sections), settings.robot) {
    perception_.set_compromise(Compromise::at(level));
  }

  void see(const TimedFrame& frame) {
    measure(perception_, memory_, frame, pool_, seen_ < kWarmUp ? warm_up_ : measured_);
    ++seen_;
  }
  [[nodiscard]] const Measured& measured() const { return measured_; }
  [[nodiscard]] double wall_ms() const { return quantile_of(measured_.wall_ms, 0.5); }
  [[nodiscard]] double cpu_ms() const { return quantile_of(measured_.cpu_ms, 0.5); }
  [[nodiscard]] std::string name() const {
    return fmt::format("{} x {} sections, {} thread{}", sections_.x_res, sections_.y_res, pool_.workers(),
                       pool_.workers() > 1 ? "s" : "");
  }
  [[nodiscard]] nlohmann::json json() const {
    nlohmann::json stages;
    for (std::size_t s = 0; s < kStageNames.size(); ++s)
      stages[kStageNames[s]] = quantile_of(measured_.stages[s], 0.5);
    const auto frames = static_cast<std::int64_t>(measured_.wall_ms.size());
    return {{"name", name()},
            {"frames", frames},
            {"points", measured_.points / frames},
            {"median_ms", wall_ms()},
            {"p99_ms", quantile_of(measured_.wall_ms, 0.99)},
            {"cpu_median_ms", cpu_ms()},
            {"near_first_median_ms", quantile_of(measured_.near_first_ms, 0.5)},
            {"stages", stages}};
  }

 private:
  static constexpr int kWarmUp = 3;

  static PerceptionSettings with(const BenchSettings& settings, const SectionSettings& sections) {
    PerceptionSettings perception = settings.perception;
    perception.sections = sections;
    return perception;
  }

  SectionSettings sections_;
  ThreadPool pool_;
  FloorPerception perception_;
  FramePixels memory_;
  int seen_ = 0;
  Measured warm_up_, measured_;
};

void print(const PerceptionOptions& options, const std::array<Contestant, 3>& contestants) {
  const Measured& first = contestants[0].measured();
  const auto frames = static_cast<std::int64_t>(first.wall_ms.size());
  fmt::print("{} frames, {} points a frame in the region of interest, from the cloud's bytes to messages\n",
             frames, first.points / frames);
  if (options.level > 0) fmt::print("with {}\n", Compromise::at(options.level).text());
  fmt::print("{:<28}{:>10}{:>10}{:>10}{:>22}\n", "", "CPU ms", "wall ms", "99 %", "nearest row, wall ms");
  for (const Contestant& c : contestants)
    fmt::print("{:<28}{:>10.1f}{:>10.1f}{:>10.1f}{:>22.1f}\n", c.name(), c.cpu_ms(), c.wall_ms(),
               quantile_of(c.measured().wall_ms, 0.99), quantile_of(c.measured().near_first_ms, 0.5));
  fmt::print("{} threads {:.2f} times as fast as one; {} {:.2f} times the CPU time\nstages, CPU ms:",
             options.threads, contestants[0].wall_ms() / contestants[1].wall_ms(), contestants[2].name(),
             contestants[2].cpu_ms() / contestants[0].cpu_ms());
  for (std::size_t s = 0; s < kStageNames.size(); ++s)
    fmt::print(" {} {:.1f}", kStageNames[s], quantile_of(first.stages[s], 0.5));
  fmt::print("\n");
}

void run(const PerceptionOptions& options) {
  constexpr int kRendered = 10;
  BenchSettings settings;
  if (!options.config.empty()) read_robot_file(options.config, settings);
  const auto sensor = options.sensor == "kinect" ? SensorKind::kKinect : SensorKind::kBumblebee;
  const auto frames = options.log.empty() ? rendered_frames(sensor, kRendered) : frames_of_log(options.log);
  const SectionSettings sections = settings.perception.sections;
  const SectionSettings finest{.x_res = 12, .y_res = 9, .layout = sections.layout};
  std::array<Contestant, 3> contestants{Contestant(settings, sections, 1, options.level),
                                        Contestant(settings, sections, options.threads, options.level),
                                        Contestant(settings, finest, 1, options.level)};
  for (int i = 0; i < options.repeats; ++i)
    for (const TimedFrame& frame : frames)
      for (Contestant& contestant : contestants) contestant.see(frame);
  if (!options.json) return print(options, contestants);
  nlohmann::json result = nlohmann::json::array();
  for (const Contestant& contestant : contestants) result.push_back(contestant.json());
  fmt::print("{}\n", result.dump());
}

}  // namespace

void add_perception_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "perception", "Time of perception and its stages: on one thread, on several, with 12 x 9 sections");
  const auto options = std::make_shared<PerceptionOptions>();
  command->add_option("--log", options->log, "With clouds and poses, instead of rendered frames")
      ->check(CLI::ExistingFile);
  command->add_option("--sensor", options->sensor, "Whose frames are rendered")
      ->check(CLI::IsMember({"kinect", "bumblebee"}))
      ->capture_default_str();
  command->add_option("--config", options->config, "The robot's file")->check(CLI::ExistingFile);
  command->add_option("--threads", options->threads)->check(CLI::Range(2, 64))->capture_default_str();
  command->add_option("--repeats", options->repeats, "Rounds through the frames")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--level", options->level, "What is given up: 0 nothing, each level one thing more")
      ->check(CLI::Range(0, Compromise::kLevels - 1))
      ->capture_default_str();
  command->add_flag("--json", options->json, "For programs");
  command->callback([options] { run(*options); });
}

}  // namespace floornav
