#include <atomic>
#include <cmath>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "runtime/process/settings_reader.hpp"
#include "runtime/process/stop_signals.hpp"
#include "tools/command_line/one_line_error.hpp"
#include "tools/progress/progress.hpp"
#include "tools/replay/replay.hpp"

namespace {

using namespace floornav;

constexpr int kInterruptedExit = 130;
Eigen::Vector2d parse_goal(const std::string& text) {
  Eigen::Vector2d goal;
  const std::size_t comma = text.find(',');
  const auto number = [&](const std::string& word) {
    std::size_t used = 0;
    const double value = std::stod(word, &used);
    if (used != word.size() || !std::isfinite(value)) throw std::invalid_argument(word);
    return value;
  };
  try {
    if (comma == std::string::npos) throw std::invalid_argument(text);
    return {number(text.substr(0, comma)), number(text.substr(comma + 1))};
  } catch (const std::logic_error&) {
    throw std::runtime_error(fmt::format("--goal \"{}\" is not X,Y in m", text));
  }
}

constexpr const char* kFooter = R"(
Outputs in DIR: map.yaml, map.pgm, belief.tiff, height.tiff, map.png, terrain.png, surfels.csv, frames.csv,
summary.json, result.lcm (what the nodes published, in the log's time); path.csv with --goal; frames/ with
--frame-pictures. The same log gives the same bytes (timing in summary.json aside).

Examples:
  floornav-replay room.lcm --out out --goal 6.5,1.0
  floornav-replay rpy.lcm --out out --config robot.yaml --threads 2
  floornav-replay pepper.lcm --out out --frame-pictures)";

int run_program(int argc, char** argv) {
  CLI::App app(
      "Runs perception, mapper and planner over an LCM log, in one process and in the log's own time");
  app.name("floornav-replay");
  tell_errors_in_one_line(app);
  app.footer(kFooter);
  ReplayRequest request;
  std::string config;
  std::string goal;
  app.add_option("LOG", request.log, "The log, with clouds and POSE")->required();
  app.add_option("--out", request.out, "Folder for the outputs")->required()->type_name("DIR");
  app.add_option("--config", config, "The robot's YAML file; what it leaves out has its default")
      ->type_name("FILE");
  app.add_option("--goal", goal, "Where to plan to, m in the local frame")->type_name("X,Y");
  app.add_option("--threads", request.threads, "Of perception")
      ->check(CLI::Range(1, 256))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--deadline-ms", request.deadline_ms, "A frame's budget, counted in estimated work")
      ->check(CLI::Range(0.1, 1e6))
      ->type_name("D");
  app.add_flag("--frame-pictures", request.frame_pictures, "Draw every frame beside the map that came of it");
  app.add_flag("--salvage", request.salvage, "Replay what is whole of a damaged log");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  if (!config.empty()) read_robot_file(config, request.settings);
  if (!goal.empty()) request.goal = parse_goal(goal);

  const std::atomic<bool>& stop_asked = stop_on_signals();
  Progress progress("clouds");
  const bool whole = replay(request, [&](std::int64_t done, std::int64_t total) {
    progress.at(done, total);
    return !stop_asked;
  });
  if (whole) return 0;
  fmt::print(stderr, "floornav-replay: interrupted; the outputs are those of the part that was replayed\n");
  return kInterruptedExit;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "floornav-replay: {}\n", error.what());
    return 1;
  }
}
