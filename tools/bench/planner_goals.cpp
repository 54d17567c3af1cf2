#include "tools/bench/planner_goals.hpp"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "planner/gap_field.hpp"
#include "planner/outline_search.hpp"
#include "planner/planner.hpp"
#include "planner/planning_grid.hpp"
#include "planner/search/grid_search.hpp"
#include "tools/bench/d_star_lite.hpp"
#include "tools/bench/movingai.hpp"
#include "tools/bench/planner_maps.hpp"
#include "tools/bench/processor_time.hpp"
#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

constexpr double kPitch_m = 0.05;
constexpr double kMs = 1e-3;  ///< of a microsecond

void print(const std::string& what, const std::string& goal, const std::string& measured) {
  fmt::print("{:<66}{:<22}{}\n", what, goal, measured);
  std::fflush(stdout);
}

std::string mean_and_p99(const Times& times) {
  return fmt::format("mean {:.2f} ms, p99 {:.2f} ms ({} searches)", kMs * times.mean(), kMs * times.at(0.99),
                     times.us.size());
}

PlannerSettings uniform_settings() {
  PlannerSettings settings;
  settings.unknown_cost = settings.belief_cost = settings.slope_cost = settings.clearance_cost = 0;
  return settings;
}

CellRect all_of(std::int32_t side) {
  return {0, 0, side, side};
}

/// A cell, by chance, where the robot fits.
GridCell any_place(const PlanningGrid& grid, std::int32_t side, RandomStream& random) {
  for (;;) {
    const GridCell cell =
        grid.cell_of(random.uniform(0, side * kPitch_m), random.uniform(0, side * kPitch_m));
    if (grid.passable(cell) && grid.floor(cell) == Floor::kFree) return cell;
  }
}

/// As the planner calls it.
SearchOutcome search_way(GridSearch& search, const PlanningGrid& grid, GridCell start, GridCell goal) {
  return search.search(grid.search_grid(), grid.aids(), start, goal, {}, OnNoPath::kTellEarly);
}

/// Searches between places all over an office.
Times searches_on_office(std::int32_t side, const PlannerSettings& settings, int count) {
  const GridMap map = office_map(side, 1);
  PlanningGrid grid(settings, RobotSettings{});
  grid.update(map, all_of(side), {});
  GridSearch search;
  RandomStream random(2);
  Times times;
  for (int i = -2; i < count; ++i) {
    const GridCell start = any_place(grid, side, random), goal = any_place(grid, side, random);
    Times warm_up;
    (i < 0 ? warm_up : times).add([&] { search_way(search, grid, start, goal); });
  }
  return times;
}

/// The whole of it on a map that does not change: the way, its shape and its speeds.
Times plans_in_office(std::int32_t side, int count) {
  const GridMap map = office_map(side, 1);
  PlanningGrid grid({}, RobotSettings{});
  grid.update(map, all_of(side), {});
  Planner planner({}, RobotSettings{});
  RandomStream random(2);
  Times times;
  for (int i = -2; i < count; ++i) {
    const GridCell start = any_place(grid, side, random), goal = any_place(grid, side, random);
    Pose T_world_body = Pose::Identity();
    T_world_body.translation() = Eigen::Vector3d(grid.x_of(start.x), grid.y_of(start.y), 0);
    Times warm_up;
    (i < 0 ? warm_up : times).add([&] {
      planner.plan(map, T_world_body, {grid.x_of(goal.x), grid.y_of(goal.y), 0.1});
    });
  }
  return times;
}

/// Where a robot of 1.0 m x 0.5 m, which is no circle, is free to stand and to set out.
Times outline_searches_on_office(std::int32_t side, int count) {
  RobotSettings robot;
  robot.radius_m = 0.62;
  robot.footprint = {{0.5, 0.25}, {-0.5, 0.25}, {-0.5, -0.25}, {0.5, -0.25}};
  const GridMap map = office_map(side, 1);
  PlanningGrid grid({}, robot);
  grid.update(map, all_of(side), {});
  OutlineSearch search;
  RandomStream random(2);
  Times times;
  while (times.us.size() < static_cast<std::size_t>(count)) {
    const GridCell start = any_place(grid, side, random), goal = any_place(grid, side, random);
    if (!grid.roomy(start)) continue;
    times.add([&] { search.search(grid, start, random.uniform(0, 6), goal); });
  }
  return times;
}

/// A box appears on the way, 1 m before the robot, and goes again: from the map's change to the new path.
/// Beside it the search alone, afresh and repaired.
struct Changes {
  Times update_and_search, afresh, repaired;
};

Changes changes_near_robot(std::int32_t side, const PlannerSettings& settings, int count) {
  GridMap map = office_map(side, 1);
  PlanningGrid grid(settings, RobotSettings{});
  grid.update(map, all_of(side), {});
  GridSearch search;
  DStarLite incremental;
  RandomStream random(3);
  Changes result;
  std::vector<GridCell> path;
  while (result.afresh.us.size() < static_cast<std::size_t>(count)) {
    const GridCell start = any_place(grid, side, random), goal = any_place(grid, side, random);
    if (search_way(search, grid, start, goal) != SearchOutcome::kFound) continue;
    search.path(path);
    if (path.size() < 60) continue;
    incremental.begin(grid.search_grid(), start, goal);
    const GridCell ahead = path[25];
    const CellIndex low{grid.origin().ix + ahead.x - 3, grid.origin().iy + ahead.y - 3};
    const CellRect around = CellRect{ahead.x - 3, ahead.y - 3, ahead.x + 4, ahead.y + 4}.grown(40);
    for (const VertexState state : {VertexState::kBlocked, VertexState::kFree}) {
      set_block(map, low, 7, 7, state);
      result.update_and_search.add([&] {
        grid.update(map, all_of(side), {});
        search_way(search, grid, start, goal);
      });
      result.afresh.add([&] { search_way(search, grid, start, goal); });
      result.repaired.add([&] { incremental.repair(start, around); });
    }
  }
  return result;
}

void print_changes(const char* name, const char* goal, const PlannerSettings& settings) {
  constexpr std::int32_t kSide = 1024;
  const Changes changes = changes_near_robot(kSide, settings, 200);
  print(fmt::format("change near the robot -> new path, office 1024 x 1024, {}", name), goal,
        mean_and_p99(changes.update_and_search));
  print(fmt::format("  of that the search afresh / D* Lite's repair instead, {}", name), "",
        fmt::format("mean {:.2f} / {:.2f} ms, p99 {:.2f} / {:.2f} ms", kMs * changes.afresh.mean(),
                    kMs * changes.repaired.mean(), kMs * changes.afresh.at(0.99),
                    kMs * changes.repaired.at(0.99)));
}

void print_upscaled(const std::filesystem::path& folder) {
  constexpr std::int32_t kFactor = 8;
  for (const char* const name : {"AR0011SR", "64room_000"}) {
    const SearchGrid grid = upscaled(read_movingai_map(folder / (std::string(name) + ".map")), kFactor);
    const auto problems = read_movingai_problems(folder / (std::string(name) + ".map.scen"));
    BitGrid bits;
    project(grid, bits);
    GridSearch search;
    AStar a_star;
    Times chosen, plain;
    for (std::size_t i = 0; i < problems.size(); i += problems.size() / 40) {
      const auto scaled = [&](GridCell c) {
        return GridCell{c.x * kFactor + kFactor / 2, c.y * kFactor + kFactor / 2};
      };
      const GridCell start = scaled(problems[i].start), goal = scaled(problems[i].goal);
      chosen.add([&] { search.search(grid, {&bits}, start, goal); });
      plain.add([&] { a_star.search(grid, start, goal); });
    }
    chosen.us.erase(chosen.us.begin());
    print(fmt::format("jump points, {} upscaled to {} x {}", name, grid.width, grid.height), "<= 2 ms",
          mean_and_p99(chosen) + fmt::format("; A* {:.1f} ms", kMs * plain.mean()));
  }
}

void print_gap_field() {
  constexpr std::int32_t kSide = 1024, kWindow = 60;
  const GridMap map = office_map(kSide, 1);
  std::vector<std::uint8_t> kinds;
  for (std::int32_t y = 0; y < kSide; ++y)
    for (std::int32_t x = 0; x < kSide; ++x)
      kinds.push_back(map.state({x, y}) == VertexState::kBlocked ? 1 : 0);
  GapField field;
  constexpr std::int32_t kReach = 16;  // a PowerBot's circle of 0.52 m, its comfort and two cells
  field.reset(kSide, kSide, kReach);
  const ObstacleCells cells{kinds.data(), kSide, kSide, 1};
  field.update(cells, all_of(kSide));
  RandomStream random(4);
  Times times;
  for (int i = 0; i < 2000; ++i) {
    const auto x = static_cast<std::int32_t>(random.uniform(0, kSide - kWindow)),
               y = static_cast<std::int32_t>(random.uniform(0, kSide - kWindow));
    kinds[static_cast<std::size_t>((y + kWindow / 2) * kSide + x + kWindow / 2)] ^= 1U;
    times.add([&] { field.update(cells, {x, y, x + kWindow, y + kWindow}); });
  }
  print("distance field after a change of 3 m x 3 m, a cell of the window", "<= 5 ns",
        fmt::format("median {:.2f} ns, quickest tenth {:.2f} ns", 1e3 * times.at(0.5) / (kWindow * kWindow),
                    1e3 * times.at(0.1) / (kWindow * kWindow)));
}

/// Around a pillar two ways are equally long, and both are narrowed by noise in the map: how often the path
/// changes sides.
int changes_of_side(double keep_path_ratio) {
  constexpr std::int32_t kWide = 160, kHigh = 121;
  PlannerSettings settings;
  settings.keep_path_ratio = keep_path_ratio;
  Planner planner(settings, RobotSettings{});
  GridMap map(kPitch_m);
  set_block(map, {0, 0}, kWide, kHigh, VertexState::kFree);
  Pose T_world_body = Pose::Identity();
  T_world_body.translation() = Eigen::Vector3d(1.0, 3.025, 0);
  RandomStream random(5);
  std::optional<Plan> previous;
  int side = 0, changed = 0;
  for (int update = 0; update < 300; ++update) {
    set_block(map, {70, 40}, 20, 41, VertexState::kBlocked);
    for (const std::int32_t y : {20, 81}) {
      set_block(map, {70, y}, 20, 20, VertexState::kFree);
      for (int n = 0; n < 2; ++n)
        set_block(map, {70 + static_cast<std::int32_t>(random.uniform(0, 19)), y < 40 ? 39 : 81}, 1, 1,
                  random.uniform(0, 1) < 0.5 ? VertexState::kBlocked : VertexState::kFree);
    }
    Plan plan = planner.plan(map, T_world_body, {7, 3.025, 0.1}, previous ? &*previous : nullptr);
    double highest_m = 0;
    for (const PathPoint& p : plan.points) highest_m = std::max(highest_m, p.y_m);
    const int now = highest_m > 4.0 ? 1 : -1;
    changed += side != 0 && now != side ? 1 : 0;
    side = now;
    previous = std::move(plan);
  }
  return changed;
}

}  // namespace

void print_planner_goals(const std::filesystem::path& movingai_folder) {
  fmt::print("\n{:<66}{:<22}{}\n", "what", "goal", "measured");
  print_upscaled(movingai_folder);
  print("A* with costs, office of 50 m x 50 m at 0.05 m", "<= 10 ms",
        mean_and_p99(searches_on_office(992, {}, 200)));
  print("  the whole plan: way, shape and speeds", "", mean_and_p99(plans_in_office(992, 60)));
  print_changes("uniform", "p99 <= 5 ms", uniform_settings());
  print_changes("with costs", "p99 <= 20 ms", {});
  print("4096 x 4096 with clearance costs, office", "<= 100 ms",
        mean_and_p99(searches_on_office(4096, {}, 40)));
  print("robot that is no circle, with costs, office of 25 m x 25 m", "",
        mean_and_p99(outline_searches_on_office(512, 40)));
  print_gap_field();
  print("changes of side in 300 noisy maps, hysteresis / none", "few",
        fmt::format("{} / {}", changes_of_side(PlannerSettings{}.keep_path_ratio), changes_of_side(1.0)));
}

}  // namespace floornav
