#include "tools/bench/planner_command.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "planner/search/a_star.hpp"
#include "planner/search/bit_grid.hpp"
#include "planner/search/jump_point_search.hpp"
#include "tools/bench/movingai.hpp"
#ifdef FLOORNAV_BOOST_GRAPH
#include "tools/bench/boost_peer.hpp"
#endif

namespace floornav {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string map, scen, folder, search = "astar";
  bool csv = false;
  int every = 1;
};

struct Solution {
  bool found = false;
  double length = 0;
  std::int64_t expanded = 0;
};
using Solver = std::function<Solution(const MovingAiProblem&)>;

struct Measured {
  std::vector<double> microseconds;
  std::size_t optimal = 0;
  std::int64_t expanded = 0;

  [[nodiscard]] double mean_us() const {
    double sum = 0;
    for (const double us : microseconds) sum += us;
    return microseconds.empty() ? 0.0 : sum / static_cast<double>(microseconds.size());
  }
  [[nodiscard]] double p99_us() const {
    if (microseconds.empty()) return 0;
    std::vector<double> sorted = microseconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[(sorted.size() - 1) * 99 / 100];
  }
};

/// As the published length, but for the rounding of its last digit or of its eight-digit sums.
bool has_published_length(const MovingAiProblem& p, const Solution& s) {
  return s.found && std::abs(s.length - p.optimal) <= std::max(0.51 * p.last_digit, 1e-5);
}

Solver a_star_solver(const SearchGrid& grid) {
  return [&grid, a_star = std::make_shared<AStar>(),
          path = std::vector<GridCell>()](const MovingAiProblem& p) mutable {
    if (a_star->search(grid, p.start, p.goal) != SearchOutcome::kFound) return Solution{};
    a_star->path_to(p.goal, path);
    return Solution{true, path_length(path), a_star->expanded()};
  };
}

Solver jump_point_solver(const SearchGrid& grid) {
  auto bits = std::make_shared<BitGrid>();
  project(grid, *bits);
  return [bits, search = std::make_shared<JumpPointSearch>(),
          path = std::vector<GridCell>()](const MovingAiProblem& p) mutable {
    if (search->search(*bits, p.start, p.goal) != SearchOutcome::kFound) return Solution{};
    search->path(path);
    return Solution{true, path_length(path), search->expanded()};
  };
}

/// The peer, where the build has it. Costs in steps of 5741 and 8119 stand for lengths exactly enough to
/// compare.
Solver boost_solver([[maybe_unused]] const SearchGrid& grid) {
#ifdef FLOORNAV_BOOST_GRAPH
  return [peer = std::make_shared<BoostPeer>(grid)](const MovingAiProblem& p) {
    const auto cost = peer->search(p.start, p.goal);
    return cost ? Solution{true, static_cast<double>(*cost) / kExactSteps.straight, 0} : Solution{};
  };
#else
  return {};
#endif
}

using Report =
    std::function<void(std::size_t problem, const MovingAiProblem&, const Solution&, double microseconds)>;

/// Of this thread: other programs on the machine do not count.
double processor_time_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

Measured measure(const std::vector<MovingAiProblem>& problems, int every, const Solver& solve,
                 const Report& report) {
  Measured measured;
  for (std::size_t i = 0; i < problems.size(); i += static_cast<std::size_t>(every)) {
    const MovingAiProblem& p = problems[i];
    const double begin_us = processor_time_us();
    const Solution s = solve(p);
    const double took_us = processor_time_us() - begin_us;
    measured.microseconds.push_back(took_us);
    measured.optimal += has_published_length(p, s) ? 1 : 0;
    measured.expanded += s.expanded;
    report(i, p, s, took_us);
  }
  return measured;
}

struct Benchmark {
  fs::path map, scen;
};

std::vector<Benchmark> benchmarks_of(const Options& options) {
  if (options.folder.empty()) return {{options.map, options.scen}};
  std::vector<Benchmark> all;
  for (const auto& entry : fs::directory_iterator(options.folder))
    if (entry.path().extension() == ".map") all.push_back({entry.path(), entry.path().string() + ".scen"});
  std::sort(all.begin(), all.end(), [](const Benchmark& a, const Benchmark& b) { return a.map < b.map; });
  if (all.empty()) throw std::runtime_error(options.folder + ": no *.map in it");
  return all;
}

void print_csv(const Options& options, const Benchmark& benchmark) {
  const SearchGrid grid = read_movingai_map(benchmark.map);
  const std::string name = benchmark.map.stem().string();
  measure(read_movingai_problems(benchmark.scen), options.every,
          options.search == "jps" ? jump_point_solver(grid) : a_star_solver(grid),
          [&](std::size_t problem, const MovingAiProblem& p, const Solution& s, double us) {
            fmt::print("{},{},{:.8f},{:.8f},{:.1f},{}\n", name, problem, p.optimal, s.found ? s.length : -1.0,
                       us, s.expanded);
          });
}

void print_table_line(const Options& options, const Benchmark& benchmark) {
  const SearchGrid grid = read_movingai_map(benchmark.map);
  const auto problems = read_movingai_problems(benchmark.scen);
  const Report silent = [](std::size_t, const MovingAiProblem&, const Solution&, double) {};
  const Measured a_star = measure(problems, options.every, a_star_solver(grid), silent);
  const Measured jumps = measure(problems, options.every, jump_point_solver(grid), silent);
  const std::size_t count = a_star.microseconds.size();
  const double expanded = static_cast<double>(a_star.expanded) / static_cast<double>(count);
  fmt::print("{:<18}{:>6}{:>10.1f}{:>10.1f}{:>8.1f}{:>8}{:>10.1f}{:>10.1f}{:>8}{:>8.1f}",
             benchmark.map.stem().string(), count, a_star.mean_us(), a_star.p99_us(),
             expanded / a_star.mean_us(), count - a_star.optimal, jumps.mean_us(), jumps.p99_us(),
             count - jumps.optimal, a_star.mean_us() / jumps.mean_us());
  if (const Solver boost = boost_solver(grid)) {
    const Measured peer = measure(problems, options.every, boost, silent);
    fmt::print("{:>10.1f}{:>8}{:>8.1f}", peer.mean_us(), count - peer.optimal,
               peer.mean_us() / a_star.mean_us());
  } else {
    fmt::print("  (built without Boost.Graph)");
  }
  fmt::print("\n");
}

void run(const Options& options) {
  if (options.csv) {
    fmt::print("map,problem,optimal,length,microseconds,expanded\n");
    for (const Benchmark& benchmark : benchmarks_of(options)) print_csv(options, benchmark);
    return;
  }
  fmt::print("Microseconds of processor time a problem; wrong: lengths other than the published ones\n");
  fmt::print("{:<18}{:>6}{:>10}{:>10}{:>8}{:>8}{:>10}{:>10}{:>8}{:>8}{:>10}{:>8}{:>8}\n", "map", "n", "A*",
             "p99", "exp/us", "wrong", "jumps", "p99", "wrong", "A*/j", "Boost A*", "wrong", "B/A*");
  for (const Benchmark& benchmark : benchmarks_of(options)) print_table_line(options, benchmark);
}

}  // namespace

void add_planner_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand(
      "planner", "Path searches on Moving AI maps, beside Boost.Graph's A* in the same run");
  auto* const map = command->add_option("--map", options->map, "a *.map of the Moving AI benchmarks");
  auto* const scen = command->add_option("--scen", options->scen, "its *.scen")->needs(map);
  map->needs(scen);
  command->add_option("--folder", options->folder, "all X.map with their X.map.scen in a folder")
      ->excludes(map);
  command->add_flag("--csv", options->csv,
                    "a line a problem: map,problem,optimal,length,microseconds,expanded");
  command->add_option("--search", options->search, "what --csv measures")
      ->check(CLI::IsMember({"astar", "jps"}))
      ->capture_default_str();
  command->add_option("--every", options->every, "take every Nth problem only")
      ->check(CLI::Range(1, 1000000));
  command->callback([options] {
    if (options->map.empty() && options->folder.empty())
      throw CLI::RequiredError("planner: --map M --scen S, or --folder DIR");
    run(*options);
  });
}

}  // namespace floornav
