#include "tools/bench/perception_command.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "perception/node/perception_node.hpp"
#include "perception/node/surfels_message.hpp"
#include "runtime/geometry/pose_history.hpp"
#include "runtime/process/log_reader.hpp"
#include "runtime/process/settings_reader.hpp"
#include "runtime/process/thread_pool.hpp"
#include "tools/bench/cpu_clock.hpp"

namespace floornav {
namespace {

using Clock = std::chrono::steady_clock;

struct PerceptionOptions {
  std::filesystem::path log;
  std::filesystem::path config;
  int threads = 1;
  int repeats = 1;
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

/// A frame's clouds and the body's pose at its time.
struct TimedFrame {
  CloudStrips strips;
  Pose T_world_body;
};

/// The log's clouds of both cameras that have a pose.
std::vector<TimedFrame> read_frames(const std::filesystem::path& log) {
  LogReader reader(log);
  constexpr std::int64_t kDay_us = 86'400'000'000;
  PoseHistory poses(kDay_us);
  CloudAssembly kinect, bumblebee;
  std::vector<CloudStrips> clouds;
  for (LogEvent event; reader.next(event);) {
    const int size = static_cast<int>(event.bytes.size());
    if (event.channel == channel::kPose) {
      pose_t pose;
      if (pose.decode(event.bytes.data(), 0, size) == size)
        poses.insert(pose.utime, pose_from_arrays(pose.pos, pose.orientation));
    } else if (event.channel == channel::kKinectCloud || event.channel == channel::kBumblebeeCloud) {
      depth_cloud_t cloud;
      if (cloud.decode(event.bytes.data(), 0, size) != size) continue;
      CloudAssembly& assembly = event.channel == channel::kKinectCloud ? kinect : bumblebee;
      if (auto strips = assembly.add(cloud)) clouds.push_back(std::move(*strips));
    }
  }
  std::vector<TimedFrame> frames;
  for (CloudStrips& strips : clouds)
    if (const auto pose = poses.at(strips.front().utime)) frames.push_back({std::move(strips), *pose});
  if (frames.empty()) throw std::runtime_error(log.string() + ": no cloud with a body pose around its time");
  return frames;
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

void print(const PerceptionOptions& options, const Measured& m) {
  const auto frames = static_cast<std::int64_t>(m.wall_ms.size());
  if (options.json) {
    nlohmann::json stages;
    for (std::size_t s = 0; s < kStageNames.size(); ++s)
      stages[kStageNames[s]] = quantile_of(m.stages[s], 0.5);
    const nlohmann::json result{{"frames", frames},
                                {"points", m.points / frames},
                                {"threads", options.threads},
                                {"level", options.level},
                                {"median_ms", quantile_of(m.wall_ms, 0.5)},
                                {"p99_ms", quantile_of(m.wall_ms, 0.99)},
                                {"cpu_median_ms", quantile_of(m.cpu_ms, 0.5)},
                                {"near_first_median_ms", quantile_of(m.near_first_ms, 0.5)},
                                {"stages", stages}};
    fmt::print("{}\n", result.dump());
    return;
  }
  fmt::print("{} frames, {} points a frame in the region of interest, {} thread(s)\n", frames,
             m.points / frames, options.threads);
  fmt::print("from cloud to messages: median {:.1f} ms, 99 % {:.1f} ms; CPU of all threads {:.1f} ms\n",
             quantile_of(m.wall_ms, 0.5), quantile_of(m.wall_ms, 0.99), quantile_of(m.cpu_ms, 0.5));
  if (options.level > 0) fmt::print("with {}\n", Compromise::at(options.level).text());
  fmt::print("nearest row's messages: {:.1f} ms after decoding\nCPU time of all threads:\n",
             quantile_of(m.near_first_ms, 0.5));
  for (std::size_t s = 0; s < kStageNames.size(); ++s)
    fmt::print("  {:<9}{:6.1f} ms\n", kStageNames[s], quantile_of(m.stages[s], 0.5));
}

void run(const PerceptionOptions& options) {
  BenchSettings settings;
  if (!options.config.empty()) read_robot_file(options.config, settings);
  const auto frames = read_frames(options.log);
  ThreadPool pool(options.threads);
  FloorPerception perception(settings.perception, settings.robot);
  perception.set_compromise(Compromise::at(options.level));
  FramePixels memory;
  Measured warm_up, measured;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, frames.size()); ++i)
    measure(perception, memory, frames[i], pool, warm_up);
  for (int i = 0; i < options.repeats; ++i)
    for (const TimedFrame& frame : frames) measure(perception, memory, frame, pool, measured);
  print(options, measured);
}

}  // namespace

void add_perception_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("perception", "Time of perception and its stages over a log's clouds");
  const auto options = std::make_shared<PerceptionOptions>();
  command->add_option("--log", options->log, "With clouds and poses")->required()->check(CLI::ExistingFile);
  command->add_option("--config", options->config, "The robot's file")->check(CLI::ExistingFile);
  command->add_option("--threads", options->threads)->check(CLI::Range(1, 64))->capture_default_str();
  command->add_option("--repeats", options->repeats, "Rounds through the log")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--level", options->level, "What is given up: 0 nothing, each level one thing more")
      ->check(CLI::Range(0, Compromise::kLevels - 1))
      ->capture_default_str();
  command->add_flag("--json", options->json, "For programs");
  command->callback([options] { run(*options); });
}

}  // namespace floornav
