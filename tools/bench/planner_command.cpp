#include "tools/bench/planner_command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "planner/search/a_star.hpp"
#include "planner/search/bit_grid.hpp"
#include "planner/search/grid_search.hpp"
#include "planner/search/jump_point_search.hpp"
#include "tools/bench/movingai.hpp"
#include "tools/bench/planner_goals.hpp"
#include "tools/bench/processor_time.hpp"
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
  Times times;
  std::size_t optimal = 0;
  std::int64_t expanded = 0;

  [[nodiscard]] std::size_t count() const { return times.us.size(); }
  [[nodiscard]] std::size_t wrong() const { return count() - optimal; }
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

Solver chosen_solver(const SearchGrid& grid) {
  auto bits = std::make_shared<BitGrid>();
  project(grid, *bits);
  return [&grid, bits, search = std::make_shared<GridSearch>(),
          path = std::vector<GridCell>()](const MovingAiProblem& p) mutable {
    if (search->search(grid, {bits.get()}, p.start, p.goal) != SearchOutcome::kFound) return Solution{};
    search->path(path);
    return Solution{true, path_length(path), 0};
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

Measured measure(const std::vector<MovingAiProblem>& problems, int every, const Solver& solve,
                 const Report& report) {
  Measured measured;
  for (std::size_t i = 0; i < problems.size(); i += static_cast<std::size_t>(every)) {
    const MovingAiProblem& p = problems[i];
    Solution s;
    measured.times.add([&] { s = solve(p); });
    measured.optimal += has_published_length(p, s) ? 1 : 0;
    measured.expanded += s.expanded;
    report(i, p, s, measured.times.us.back());
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

struct Row {
  std::string map;
  Measured a_star, jumps, chosen, boost;
};

Row measure_row(const Options& options, const Benchmark& benchmark) {
  const SearchGrid grid = read_movingai_map(benchmark.map);
  const auto problems = read_movingai_problems(benchmark.scen);
  const auto with = [&](const Solver& solver) {
    return measure(problems, options.every, solver,
                   [](std::size_t, const MovingAiProblem&, const Solution&, double) {});
  };
  Row row;
  row.map = benchmark.map.stem().string();
  row.a_star = with(a_star_solver(grid));
  row.jumps = with(jump_point_solver(grid));
  row.chosen = with(chosen_solver(grid));
  if (const Solver boost = boost_solver(grid)) row.boost = with(boost);
  return row;
}

void print_row(const Row& row) {
  const double a_star_us = row.a_star.times.mean(), jumps_us = row.jumps.times.mean();
  fmt::print("{:<16}{:>6}{:>10.1f}{:>8.1f}{:>7}{:>10.1f}{:>7}{:>8.1f}{:>10.1f}{:>7}{:>8.2f}", row.map,
             row.a_star.count(), a_star_us,
             static_cast<double>(row.a_star.expanded) / static_cast<double>(row.a_star.count()) / a_star_us,
             row.a_star.wrong(), jumps_us, row.jumps.wrong(), a_star_us / jumps_us, row.chosen.times.mean(),
             row.chosen.wrong(), row.chosen.times.mean() / std::min(a_star_us, jumps_us));
  if (row.boost.count() > 0)
    fmt::print("{:>10.1f}{:>7}{:>8.1f}", row.boost.times.mean(), row.boost.wrong(),
               row.boost.times.mean() / a_star_us);
  fmt::print("\n");
  std::fflush(stdout);
}

enum class Kind { kGame, kRooms, kCity, kOther };

/// Moving AI's names: mazes and random fields are called so, cities begin with a capital and end with a size.
Kind kind_of(const std::string& map) {
  if (map.starts_with("maze") || map.starts_with("random")) return Kind::kOther;
  if (map.find("room") != std::string::npos) return Kind::kRooms;
  const bool sized = map.ends_with("_256") || map.ends_with("_512") || map.ends_with("_1024");
  return sized && map.front() >= 'A' && map.front() <= 'Z' ? Kind::kCity : Kind::kGame;
}

void print_mean(const char* what, const std::vector<double>& ratios) {
  if (ratios.empty()) return;
  double sum = 0;
  for (const double ratio : ratios) sum += ratio;
  fmt::print("{}: mean {:.1f}, least {:.1f} times\n", what, sum / static_cast<double>(ratios.size()),
             *std::min_element(ratios.begin(), ratios.end()));
}

void print_means(const std::vector<Row>& rows) {
  std::vector<double> boost, jumps;
  for (const Row& row : rows) {
    const Kind kind = kind_of(row.map);
    if (kind == Kind::kOther) continue;
    jumps.push_back(row.a_star.times.mean() / row.jumps.times.mean());
    if (kind != Kind::kCity && row.boost.count() > 0)
      boost.push_back(row.boost.times.mean() / row.a_star.times.mean());
  }
  print_mean("A* over Boost.Graph's, game and room maps", boost);
  print_mean("jump points over A*, game, room and city maps", jumps);
}

void print_table(const Options& options) {
  fmt::print("Mean microseconds of processor time a problem; wrong: lengths other than the published ones\n");
  fmt::print("{:<16}{:>6}{:>10}{:>8}{:>7}{:>10}{:>7}{:>8}{:>10}{:>7}{:>8}{:>10}{:>7}{:>8}\n", "map", "n",
             "A*", "exp/us", "wrong", "jumps", "wrong", "A*/j", "chosen", "wrong", "/best", "Boost A*",
             "wrong", "B/A*");
  std::vector<Row> rows;
  for (const Benchmark& benchmark : benchmarks_of(options)) {
    rows.push_back(measure_row(options, benchmark));
    print_row(rows.back());
  }
  print_means(rows);
#ifndef FLOORNAV_BOOST_GRAPH
  fmt::print("(built without Boost.Graph)\n");
#endif
}

void run(const Options& options) {
  if (!options.csv) {
    print_table(options);
    if (!options.folder.empty()) print_planner_goals(options.folder);
    return;
  }
  fmt::print("map,problem,optimal,length,microseconds,expanded\n");
  for (const Benchmark& benchmark : benchmarks_of(options)) print_csv(options, benchmark);
}

}  // namespace

void add_planner_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand(
      "planner", "Path searches on Moving AI maps, beside Boost.Graph's A* in the same run");
  auto* const map = command->add_option("--map", options->map, "a *.map of the Moving AI benchmarks");
  auto* const scen = command->add_option("--scen", options->scen, "its *.scen")->needs(map);
  map->needs(scen);
  command
      ->add_option("--folder", options->folder,
                   "all X.map with their X.map.scen in a folder, then large maps, costs and changes")
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
