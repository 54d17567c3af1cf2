#include "planner/planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "planner/clear_way.hpp"
#include "planner/nearest_cell.hpp"
#include "planner/path_shape.hpp"
#include "planner/shortening.hpp"
#include "planner/speed_profile.hpp"
#include "planner/taut_way.hpp"

namespace floornav {
namespace {

/// A way ends in a cell whose centre is no further from the goal than this, whatever the tolerance.
constexpr double kEndCells = 0.75;
/// The goal counts as reached from here on: it covers the cell in which a way may end.
constexpr double kReachedCells = 1.5;
/// Slower than this the robot stands.
constexpr double kAtRest_mps = 0.1;
/// What passes between a pose and the wheels' answer to the path that begins there.
constexpr double kReaction_s = 0.2;
/// Beyond its own radius a robot that does not fit where it stands looks this far for a place where it does.
constexpr double kWayOut_m = 0.3;

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

double distance(GridPoint a, GridPoint b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

void Planner::forget() {
  grid_.forget();
  assumed_.reset();
}

Plan Planner::plan(const GridMap& map, const Pose& T_world_body, const Goal& goal, const Plan* previous,
                   const Interrupt& interrupt, double speed_mps) {
  Plan plan = find_route(map, T_world_body, goal, {previous, speed_mps}, interrupt);
  plan.map_epoch = map.epoch;
  plan.map_version = map.version;
  if (plan.route.corners.empty()) return plan;
  DrivablePath path = drivable_path(grid_, map, plan.route, robot_, settings_.point_spacing_m, T_world_body);
  set_speeds(path.points, settings_, robot_);
  plan.points = std::move(path.points);
  plan.way_out_points = path.way_out_points;
  plan.length_m = path.length_m;
  plan.status = path.whole ? PlanStatus::kFollowing : PlanStatus::kFrontier;
  if (!path.whole && plan.reason.empty()) plan.reason = "the floor ahead was not seen yet";
  return plan;
}

/// A plan with a route, or with a status that says why there is none.
Plan Planner::find_route(const GridMap& map, const Pose& T_world_body, const Goal& goal, const Motion& motion,
                         const Interrupt& interrupt) {
  const auto here = T_world_body.translation();
  const double to_goal_m = std::hypot(goal.x_m - here.x(), goal.y_m - here.y());
  const bool there = to_goal_m <= std::max(goal.tolerance_m, kReachedCells * map.lattice().pitch_m);
  const Plan reached = refusal(PlanStatus::kReached, "the goal is " + in_metres(to_goal_m) + " away");
  if (there && motion.speed_mps <= kAtRest_mps) return reached;
  if (to_goal_m > settings_.max_distance_m)
    return refusal(PlanStatus::kNoPath,
                   "the goal is " + in_metres(to_goal_m) + " away, more than max_distance_m");
  try {
    bring_up_to_date(map, T_world_body, goal);
  } catch (const std::invalid_argument& error) {
    return refusal(PlanStatus::kNoPath, error.what());
  }
  if (there) return coming_to_rest(T_world_body, motion).value_or(reached);
  return search(T_world_body, goal, motion, interrupt);
}

/// What is left of its route to a robot that is near enough to its goal, until it can stop.
std::optional<Plan> Planner::coming_to_rest(const Pose& T_world_body, const Motion& motion) const {
  const std::optional<Departure> here = departure_at(T_world_body);
  if (!here) return std::nullopt;
  const Departure end = departure_in(motion, *here);
  if (!end.committed) return std::nullopt;
  Plan plan;
  plan.route = route_after(grid_, end, {centre(end.from)});
  return plan;
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
  grid_.update(map, seen.joined(ends).clipped(farthest), *assumed_,
               {here.x(), here.y(), robot_.radius_m + lattice.pitch_m});
}

Plan Planner::search(const Pose& T_world_body, const Goal& goal, const Motion& motion,
                     const Interrupt& interrupt) {
  const std::optional<Departure> at_rest = departure_at(T_world_body);
  if (!at_rest) return refusal(PlanStatus::kStartBlocked, why_start_is_blocked(T_world_body));
  const std::optional<GridCell> target = nearest_to_goal(goal, [&](GridCell c) { return grid_.passable(c); });
  if (!target) {
    return refusal(PlanStatus::kGoalBlocked,
                   "no room for the robot within " + in_metres(goal.tolerance_m) + " of the goal");
  }
  const Departure start = departure_in(motion, *at_rest);
  const SearchOutcome outcome = search_nearest(start, goal, *target, interrupt);
  auto kept = motion.previous != nullptr ? route_ahead(*motion.previous, *at_rest, goal) : std::nullopt;
  if (outcome == SearchOutcome::kInterrupted) return out_of_time(start, goal, *target, std::move(kept));
  if (outcome == SearchOutcome::kNoPath) {
    if (search_.stuck_at_start()) return refusal(PlanStatus::kStartBlocked, "no room to turn");
    return refusal(PlanStatus::kNoPath,
                   "obstacles shut off all within " + in_metres(goal.tolerance_m) + " of the goal");
  }
  Plan plan;
  plan.route = route_of_cells(start, goal);
  if (kept && !clearly_better(plan.route, *kept, at_rest->heading_rad)) plan.route = *std::move(kept);
  return plan;
}

/// What is left to do once a search was interrupted.
Plan Planner::out_of_time(const Departure& start, const Goal& goal, GridCell target,
                          std::optional<Route> kept) {
  Plan plan;
  if (kept) {
    plan.route = *std::move(kept);
  } else if (search_.shortest(grid_, start.from, target)) {
    search_.path(cells_);
    plan.route = route_of_cells(start, goal);
    plan.reason = "out of time: the shortest way, not the cheapest";
  } else {
    return refusal(PlanStatus::kInterrupted, "the search took too long");
  }
  return plan;
}

/// Searches to `target`, and where no way leads there to the nearest cell within the goal's tolerance that
/// one leads to. After kFound the way is in cells_.
SearchOutcome Planner::search_nearest(const Departure& start, const Goal& goal, GridCell target,
                                      const Interrupt& interrupt) {
  const auto search_to = [&](GridCell cell, OnNoPath on_no_path) {
    return search_.search(grid_, start.from, start.from_rad, cell, interrupt, on_no_path);
  };
  SearchOutcome outcome = search_to(target, OnNoPath::kTellEarly);
  if (outcome == SearchOutcome::kNoPath && search_.told_early()) {
    const auto next =
        nearest_to_goal(goal, [&](GridCell c) { return grid_.passable(c) && !search_.on_goal_side(c); });
    if (!next) return outcome;
    outcome = search_to(*next, OnNoPath::kSettleAll);
  }
  if (outcome == SearchOutcome::kFound) search_.path(cells_);
  if (outcome != SearchOutcome::kNoPath || search_.stuck_at_start()) return outcome;
  const auto reached = nearest_to_goal(goal, [&](GridCell c) { return search_.reached(c); });
  if (!reached) return outcome;
  search_.path_to(*reached, cells_);
  return SearchOutcome::kFound;
}

bool Planner::clearly_better(const Route& next, const Route& kept, double heading_rad) const {
  if (distance(kept.corners.back(), next.corners.back()) >= kEndCells) return true;
  const double turn_cost = settings_.turn_cost / grid_.pitch_m();
  return route_cost(grid_.search_grid(), kept, heading_rad, turn_cost) >
         settings_.keep_path_ratio * route_cost(grid_.search_grid(), next, heading_rad, turn_cost);
}

bool Planner::holds(const Plan& plan, const GridMap& map, const Pose& T_world_body, const Goal& goal) {
  if (plan.map_epoch != map.epoch || plan.route.corners.empty()) return false;
  try {
    bring_up_to_date(map, T_world_body, goal);
  } catch (const std::invalid_argument&) {
    return false;
  }
  const std::optional<Departure> start = departure_at(T_world_body);
  return start && route_ahead(plan, *start, goal).has_value();
}

std::optional<Departure> Planner::departure_at(const Pose& T_world_body) const {
  const auto here = T_world_body.translation();
  return departure(grid_, grid_.point_of(here.x(), here.y()), heading_of(T_world_body),
                   robot_.radius_m + kWayOut_m);
}

/// A robot on its way leaves that no sooner than it can stop, as long as that stretch of it holds.
Departure Planner::departure_in(const Motion& motion, const Departure& at_rest) const {
  if (motion.previous == nullptr || motion.previous->route.corners.empty()) return at_rest;
  const double speed_mps = std::min(motion.speed_mps, robot_.max_speed_mps);
  const double stopping_m =
      speed_mps * (kReaction_s + 0.5 * speed_mps / std::max(robot_.max_acceleration_mps2, 1e-3));
  return departure_from_route(grid_, at_rest, motion.previous->route, stopping_m / grid_.pitch_m(),
                              settings_.off_path_m / grid_.pitch_m())
      .value_or(at_rest);
}

std::string Planner::why_start_is_blocked(const Pose& T_world_body) const {
  const GridCell cell = grid_.cell_of(T_world_body.translation().x(), T_world_body.translation().y());
  const double clearance_m = grid_.obstacle_clearance_m(cell);
  if (clearance_m >= robot_.radius_m) return "a closed edge lies under the robot, and no way leads off it";
  return "an obstacle is " + in_metres(clearance_m) + " from the robot's centre, its radius is " +
         in_metres(robot_.radius_m) + ", and no way leads off";
}

/// The cell nearest to the goal, within its tolerance, that suits.
std::optional<GridCell> Planner::nearest_to_goal(const Goal& goal,
                                                 const std::function<bool(GridCell)>& suits) const {
  return nearest_cell(grid_.search_grid(), grid_.point_of(goal.x_m, goal.y_m), goal_reach(goal), suits);
}

double Planner::goal_reach(const Goal& goal) const {
  return std::max(goal.tolerance_m / grid_.pitch_m(), kEndCells);
}

/// The way that the last search found, with the robot's and the goal's own places at its ends where they lie
/// in the open.
Route Planner::route_of_cells(const Departure& start, const Goal& goal) const {
  const double turn_cost = settings_.turn_cost / grid_.pitch_m();
  const std::vector<GridPoint> centres =
      pulled_taut(grid_, shorten(grid_, cells_, start.from_rad), start.from_rad, turn_cost);
  std::vector<GridPoint> corners = centres;
  const auto replace = [&](GridPoint& corner, GridPoint place, GridPoint neighbour) {
    const bool stays_known =
        known_free_part(grid_, place, neighbour) == 1.0 || known_free_part(grid_, corner, neighbour) < 1.0;
    if (stays_known && line_clear(grid_, place, neighbour)) corner = place;
  };
  if (corners.size() > 1) {
    if (start.at_once()) replace(corners.front(), start.here, corners[1]);
    const GridPoint end = grid_.point_of(goal.x_m, goal.y_m);
    if (distance(end, corners.back()) <= kEndCells) replace(corners.back(), end, corners[corners.size() - 2]);
  }
  Route route = route_after(grid_, start, std::move(corners));
  if (!grid_.outline().is_circle() && !route_open(grid_, route, start.heading_rad))
    route = route_after(grid_, start, centres);  // the turns are others than between centres
  return route;
}

/// What is left of a plan's route for the robot; nothing where it has left it, a line of it is shut or it
/// leads to another goal.
std::optional<Route> Planner::route_ahead(const Plan& plan, const Departure& start, const Goal& goal) const {
  if (plan.route.corners.empty()) return std::nullopt;
  auto corners =
      corners_ahead(moved(plan.route, grid_.origin()), start.here, settings_.off_path_m / grid_.pitch_m());
  if (!corners) return std::nullopt;
  const GridPoint end = grid_.point_of(goal.x_m, goal.y_m);
  if (distance(corners->back(), end) > goal_reach(goal) + kEndCells) return std::nullopt;
  if (start.way_out > 0)
    corners->insert(corners->begin(), centre(start.from));
  else
    corners->insert(corners->begin(),
                    line_clear(grid_, start.here, corners->front()) ? start.here : centre(start.from));
  Route route = route_after(grid_, start, *std::move(corners));
  if (!route_open(grid_, route, start.heading_rad)) return std::nullopt;
  return route;
}

}  // namespace floornav
