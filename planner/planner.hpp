#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/grid_map.hpp"
#include "planner/departure.hpp"
#include "planner/plan.hpp"
#include "planner/planning_grid.hpp"
#include "planner/settings.hpp"
#include "planner/way_search.hpp"
#include "runtime/geometry/pose.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Plans ways across the grid-map: a search over the cells where the robot's footprint touches nothing
/// blocked, unknown ones at a cost, of which the part over known floor is published. What it keeps between
/// calls only saves time, but for the floor assumed around the first pose of each epoch of the map. Follows
/// one map: forget() before another.
class Planner {
 public:
  /// Throws as RobotOutline.
  Planner(const PlannerSettings& settings, const RobotSettings& robot)
      : settings_(settings), robot_(robot), grid_(settings, robot) {}

  /// A plan from the pose to the goal. `previous`, where given, is the plan that the robot follows: its route
  /// is kept unless it is shut, ends elsewhere, or is clearly dearer (keep_path_ratio); at `speed_mps` the
  /// robot leaves it no sooner than where it could stop. `interrupt` may end the search.
  Plan plan(const GridMap& map, const Pose& T_world_body, const Goal& goal, const Plan* previous = nullptr,
            const Interrupt& interrupt = {}, double speed_mps = 0);

  /// Whether a plan may still be followed: the robot is on its route, and the map leaves that open.
  bool holds(const Plan& plan, const GridMap& map, const Pose& T_world_body, const Goal& goal);

  /// From now on ways keep off what was never seen within any of these circles: it was looked at in vain.
  void shut_unknown(std::vector<AssumedFloor> circles) { grid_.shut_unknown(std::move(circles)); }

  /// Another map follows, or the robot was carried elsewhere.
  void forget();

 private:
  void bring_up_to_date(const GridMap& map, const Pose& T_world_body, const Goal& goal);
  /// The plan that the robot follows, if any, and how quickly.
  struct Motion {
    const Plan* previous;
    double speed_mps;
  };
  [[nodiscard]] std::optional<Departure> departure_at(const Pose& T_world_body) const;
  [[nodiscard]] Departure departure_in(const Motion& motion, const Departure& at_rest) const;
  [[nodiscard]] std::string why_start_is_blocked(const Pose& T_world_body) const;
  [[nodiscard]] std::optional<GridCell> nearest_to_goal(const Goal& goal,
                                                        const std::function<bool(GridCell)>& suits) const;
  [[nodiscard]] double goal_reach(const Goal& goal) const;  ///< how far from it a way may end, cells
  SearchOutcome search_nearest(const Departure& start, const Goal& goal, GridCell target,
                               const Interrupt& interrupt);
  Plan find_route(const GridMap& map, const Pose& T_world_body, const Goal& goal, const Motion& motion,
                  const Interrupt& interrupt);
  [[nodiscard]] std::optional<Plan> coming_to_rest(const Pose& T_world_body, const Motion& motion) const;
  Plan search(const Pose& T_world_body, const Goal& goal, const Motion& motion, const Interrupt& interrupt);
  Plan out_of_time(const Departure& start, const Goal& goal, GridCell target, std::optional<Route> kept);
  [[nodiscard]] Route route_of_cells(const Departure& start, const Goal& goal) const;
  [[nodiscard]] std::optional<Route> route_ahead(const Plan& plan, const Departure& start,
                                                 const Goal& goal) const;
  [[nodiscard]] bool clearly_better(const Route& next, const Route& kept, double heading_rad) const;

  PlannerSettings settings_;
  RobotSettings robot_;
  PlanningGrid grid_;
  WaySearch search_;
  std::vector<GridCell> cells_;  ///< of the last search's path
  std::optional<AssumedFloor> assumed_;
  std::int32_t epoch_ = 0;
};

}  // namespace floornav
