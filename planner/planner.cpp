#include "planner/planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "planner/known_line.hpp"
#include "planner/path_shape.hpp"
#include "planner/speed_profile.hpp"

namespace floornav {
namespace {

/// A way ends in a cell whose centre is no further from the goal than this, whatever the tolerance.
constexpr double kEndCells = 0.75;
/// The goal counts as reached from here on: it covers the cell in which a way may end.
constexpr double kReachedCells = 1.5;
/// A robot that strays from a path along an obstacle starts from a cell this near where it fits.
constexpr double kStartCells = 2.0;

std::string in_metres(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f m", value);
  return text.data();
}

Plan refusal(PlanStatus status, std::string reason) {
  Plan plan;
  plan.status = status;
  plan.reason = std::move(reason);
  return plan;
}

GridPoint centre(GridCell cell) {
  return {static_cast<double>(cell.x), static_cast<double>(cell.y)};
}

double distance(GridPoint a, GridPoint b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The cell nearest to a point that suits, no further than `reach` from it; of equally near ones the first by
/// row.
template <class Suits>
std::optional<GridCell> nearest_cell(const SearchGrid& grid, GridPoint point, double reach,
                                     const Suits& suits) {
  const CellRect all{0, 0, grid.width, grid.height};
  const auto low = [&](double v) { return static_cast<std::int32_t>(std::max(std::floor(v - reach), -1.0)); };
  const auto high = [&](double v) {
    return static_cast<std::int32_t>(std::min(std::ceil(v + reach) + 1, 65536.0));
  };
  const CellRect rect = CellRect{low(point.x), low(point.y), high(point.x), high(point.y)}.clipped(all);
  std::optional<GridCell> best;
  double nearest = reach;
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
      const double d = distance(centre({x, y}), point);
      if (d > nearest || (best && d == nearest) || !suits(GridCell{x, y})) continue;
      nearest = d;
      best = GridCell{x, y};
    }
  }
  return best;
}

}  // namespace

void Planner::forget() {
  grid_.forget();
  assumed_.reset();
}

Plan Planner::plan(const GridMap& map, const Pose& T_world_body, const Goal& goal, const Plan* previous,
                   const Interrupt& interrupt) {
  Plan plan = find_route(map, T_world_body, goal, previous, interrupt);
  plan.map_epoch = map.epoch;
  plan.map_version = map.version;
  if (plan.route.corners.empty()) return plan;
  DrivablePath path =
      drivable_path(grid_, map, plan.route, settings_.point_spacing_m, T_world_body.translation().z());
  set_speeds(path.points, settings_, robot_);
  plan.points = std::move(path.points);
  plan.length_m = path.length_m;
  plan.status = path.whole ? PlanStatus::kFollowing : PlanStatus::kFrontier;
  if (!path.whole) plan.reason = "the floor ahead was not seen yet";
  return plan;
}

/// A plan with a route, or with a status that says why there is none.
Plan Planner::find_route(const GridMap& map, const Pose& T_world_body, const Goal& goal, const Plan* previous,
                         const Interrupt& interrupt) {
  const auto here = T_world_body.translation();
  const double to_goal_m = std::hypot(goal.x_m - here.x(), goal.y_m - here.y());
  if (to_goal_m <= std::max(goal.tolerance_m, kReachedCells * map.lattice().pitch_m))
    return refusal(PlanStatus::kReached, "the goal is " + in_metres(to_goal_m) + " away");
  if (to_goal_m > settings_.max_distance_m)
    return refusal(PlanStatus::kNoPath,
                   "the goal is " + in_metres(to_goal_m) + " away, more than max_distance_m");
  try {
    bring_up_to_date(map, T_world_body, goal);
  } catch (const std::invalid_argument& error) {
    return refusal(PlanStatus::kNoPath, error.what());
  }
  return search(T_world_body, goal, previous, interrupt);
}

void Planner::bring_up_to_date(const GridMap& map, const Pose& T_world_body, const Goal& goal) {
  const auto here = T_world_body.translation();
  if (!assumed_ || epoch_ != map.epoch)
    assumed_ = AssumedFloor{here.x(), here.y(), robot_.radius_m + settings_.assumed_radius_m};
  epoch_ = map.epoch;

  const Lattice& lattice = map.lattice();
  const auto around = [&](double x_m, double y_m, double by_m) {
    const CellIndex low = lattice.cell_of(x_m - by_m, y_m - by_m),
                    high = lattice.cell_of(x_m + by_m, y_m + by_m);
    return CellRect{low.ix, low.iy, high.ix + 1, high.iy + 1};
  };
  CellRect seen;
  for (const auto& [index, tile] : map.tiles())
    seen = seen.joined({index.ix * GridTile::kSide, index.iy * GridTile::kSide,
                        (index.ix + 1) * GridTile::kSide, (index.iy + 1) * GridTile::kSide});
  const double margin_m = settings_.detour_m + robot_.radius_m;
  const auto margin = static_cast<std::int32_t>(std::ceil(margin_m / lattice.pitch_m));
  const CellRect ends = around(here.x(), here.y(), margin_m).joined(around(goal.x_m, goal.y_m, margin_m));
  const CellRect farthest = around(here.x(), here.y(), settings_.max_distance_m + margin_m);
  seen = seen.clipped(farthest);
  if (!seen.empty()) seen = seen.grown(margin);
  grid_.update(map, seen.joined(ends).clipped(farthest), *assumed_);
}

Plan Planner::search(const Pose& T_world_body, const Goal& goal, const Plan* previous,
                     const Interrupt& interrupt) {
  const GridPoint here = grid_.point_of(T_world_body.translation().x(), T_world_body.translation().y());
  const std::optional<GridCell> start = start_near(here);
  if (!start) {
    const GridCell cell = grid_.cell_of(T_world_body.translation().x(), T_world_body.translation().y());
    return refusal(PlanStatus::kStartBlocked,
                   "an obstacle is " + in_metres(grid_.obstacle_clearance_m(cell)) +
                       " from the robot's centre, its radius is " + in_metres(robot_.radius_m));
  }
  std::optional<GridCell> target = nearest_to_goal(goal, false);
  if (!target) {
    return refusal(PlanStatus::kGoalBlocked,
                   "no room for the robot within " + in_metres(goal.tolerance_m) + " of the goal");
  }
  const SearchOutcome outcome = a_star_.search(grid_.search_grid(), *start, *target, interrupt);
  auto kept = previous != nullptr ? route_ahead(*previous, here) : std::nullopt;
  Plan plan;
  plan.route.origin = grid_.origin();
  if (outcome == SearchOutcome::kInterrupted) {
    if (!kept) return refusal(PlanStatus::kInterrupted, "the search took too long");
    plan.route.corners = *std::move(kept);
    return plan;
  }
  if (outcome == SearchOutcome::kNoPath) target = nearest_to_goal(goal, true);
  if (!target) {
    return refusal(PlanStatus::kNoPath,
                   "obstacles shut off all within " + in_metres(goal.tolerance_m) + " of the goal");
  }
  plan.route.corners = route_to(here, *target, goal);
  if (kept && distance(kept->back(), plan.route.corners.back()) < kEndCells &&
      route_cost(grid_.search_grid(), *kept) <=
          settings_.keep_path_ratio * route_cost(grid_.search_grid(), plan.route.corners))
    plan.route.corners = *std::move(kept);
  return plan;
}

bool Planner::holds(const Plan& plan, const GridMap& map, const Pose& T_world_body, const Goal& goal) {
  if (plan.map_epoch != map.epoch || plan.route.corners.empty()) return false;
  try {
    bring_up_to_date(map, T_world_body, goal);
  } catch (const std::invalid_argument&) {
    return false;
  }
  const auto here = T_world_body.translation();
  return route_ahead(plan, grid_.point_of(here.x(), here.y())).has_value();
}

/// The cell to start from: the robot's own, or the nearest one where its circle fits.
std::optional<GridCell> Planner::start_near(GridPoint here) const {
  return nearest_cell(grid_.search_grid(), here, kStartCells, [&](GridCell c) { return grid_.passable(c); });
}

/// The cell nearest to the goal, within its tolerance, where the robot fits; of those that the last search
/// settled where `settled` asks for it.
std::optional<GridCell> Planner::nearest_to_goal(const Goal& goal, bool settled) const {
  const double reach = std::max(goal.tolerance_m / grid_.pitch_m(), kEndCells);
  return nearest_cell(grid_.search_grid(), grid_.point_of(goal.x_m, goal.y_m), reach, [&](GridCell c) {
    return settled ? a_star_.cost_of(c) != AStar::kUnreached : grid_.passable(c);
  });
}

/// The last search's way to `target`, with the robot's and the goal's own places at its ends where they lie
/// in the open.
std::vector<GridPoint> Planner::route_to(GridPoint here, GridCell target, const Goal& goal) {
  a_star_.path_to(target, cells_);
  std::vector<GridPoint> corners = shorten(grid_, cells_);
  if (corners.size() < 2) return corners;
  const auto replace = [&](GridPoint& corner, GridPoint place, GridPoint neighbour) {
    const bool stays_known =
        known_free_part(grid_, place, neighbour) == 1.0 || known_free_part(grid_, corner, neighbour) < 1.0;
    if (stays_known && line_open(grid_.search_grid(), place, neighbour)) corner = place;
  };
  replace(corners.front(), here, corners[1]);
  const GridPoint end = grid_.point_of(goal.x_m, goal.y_m);
  if (distance(end, corners.back()) <= kEndCells) replace(corners.back(), end, corners[corners.size() - 2]);
  return corners;
}

/// What is left of a plan's route from `here`; nothing where the robot has left it or a line of it is shut.
std::optional<std::vector<GridPoint>> Planner::route_ahead(const Plan& plan, GridPoint here) const {
  const SearchGrid& grid = grid_.search_grid();
  const std::vector<GridPoint> route = moved(plan.route, grid_.origin()).corners;
  auto corners = corners_ahead(route, here, settings_.off_path_m / grid_.pitch_m());
  const std::optional<GridCell> start = start_near(here);
  if (!corners || !start) return std::nullopt;
  const bool straight = line_open(grid, here, corners->front());
  corners->insert(corners->begin(), straight ? here : centre(*start));
  if (!route_open(grid, *corners)) return std::nullopt;
  return corners;
}

}  // namespace floornav
