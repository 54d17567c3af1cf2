#include "planner/node/planner_node.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lcmtypes/channels.hpp"
#include "planner/node/path_message.hpp"
#include "runtime/process/health.hpp"
#include "runtime/process/pose_message.hpp"

namespace floornav {
namespace {

/// A pose's utime that steps back by more than this means that its sender's clock has stepped.
constexpr std::int64_t kMaxPoseDisorder_us = 1'000'000;
/// Something free must have been seen this near before the robot moves.
constexpr double kSurroundings_m = 2.5;
/// What the expansions between two looks at the budget cost, on a machine of today.
constexpr int kTicksBetweenPaths = 4;
/// Evidence is late after that many of its periods, and never sooner than this.
constexpr double kLatePeriods = 2.5;
constexpr double kSoonest_ms = 200.0;
constexpr double kSmoothing = 0.2;
/// A path shorter than this ends where the robot stands.
constexpr double kAtFrontier_m = 0.15;
/// Floor that cannot be seen is given up this far around the robot's circle.
constexpr double kGivenUp_m = 0.6;
constexpr std::int64_t kWorkBetweenInterrupts_ns = 70 * AStar::kExpansionsBetweenInterrupts;

std::chrono::duration<double, std::milli> milliseconds(double ms) {
  return std::chrono::duration<double, std::milli>(ms);
}

path_t stop_message(std::int8_t status, std::string reason) {
  path_t message{};
  message.status = status;
  message.reason = std::move(reason);
  return message;
}

}  // namespace

PlannerNode::PlannerNode(const PlannerSettings& settings, const RobotSettings& robot)
    : settings_(settings), radius_m_(robot.radius_m), planner_(settings, robot) {}

std::vector<std::string> PlannerNode::outputs() const {
  return {channel::kPath};
}

void PlannerNode::subscribe(Inbox& inbox) {
  inbox.subscribe<grid_map_t>(channel::kGridMap, Keep::kAll,
                              [this](const grid_map_t& message, Micros now) { accept_map(message, now); });
  inbox.subscribe<pose_t>(channel::kPose, Keep::kLatest,
                          [this](const pose_t& message, Micros now) { accept_pose(message, now); });
  inbox.subscribe<rigid_transform_t>(
      channel::kLocalToGlobal, Keep::kLatest, [this](const rigid_transform_t& message, Micros) {
        goal_changed_ = goal_.take(pose_from_arrays(message.trans, message.quat)) || goal_changed_;
      });
  inbox.subscribe<goal_t>(channel::kGoal, Keep::kAll, [this](const goal_t& message, Micros) {
    if (!goal_.accept(message)) return;
    goal_changed_ = true;
    open_all();
  });
}

void PlannerNode::accept_map(const grid_map_t& message, Micros now) {
  const std::int64_t utime_before_us = map_.header().utime_us;
  const bool started_before = map_.started();
  const GridMapReceiver::Change change = map_.apply(message);
  map_heard_ = now;
  if (!started_before || change.restarted) evidence_period_ms_.reset();
  if (!started_before || change.restarted || map_.header().utime_us != utime_before_us) hear_evidence(now);
  if (!change.tiles.empty() || change.restarted) inputs_changed_ = true;
  if (!change.restarted) return;
  surroundings_seen_ = false;
  plan_.reset();
  open_all();
  planner_.forget();
}

void PlannerNode::hear_evidence(Micros now) {
  const double since_ms = std::chrono::duration<double, std::milli>(now - evidence_heard_).count();
  const bool in_time = evidence_heard_ != Micros{0} && since_ms <= settings_.evidence_timeout_ms;
  if (in_time && since_ms > 0) {
    const double period_ms = evidence_period_ms_.value_or(settings_.evidence_timeout_ms / kLatePeriods);
    evidence_period_ms_ = period_ms + kSmoothing * (since_ms - period_ms);
  }
  evidence_heard_ = now;
}

std::chrono::duration<double, std::milli> PlannerNode::evidence_timeout() const {
  const double late_ms = kLatePeriods * evidence_period_ms_.value_or(settings_.evidence_timeout_ms);
  return milliseconds(std::min(std::max(late_ms, kSoonest_ms), settings_.evidence_timeout_ms));
}

void PlannerNode::accept_pose(const pose_t& message, Micros now) {
  const Pose T_world_body = body_pose(message);
  const bool older = message.utime <= pose_utime_us_ && message.utime > pose_utime_us_ - kMaxPoseDisorder_us;
  if (pose_heard_ && older) {
    ++old_poses_;
    return;
  }
  T_world_body_ = T_world_body;
  speed_.add(message.utime, T_world_body);
  pose_utime_us_ = message.utime;
  pose_heard_ = now;
  inputs_changed_ = true;
}

void PlannerNode::tick(Micros now, Outbox&) {
  ticks_ = (ticks_ + 1) % kTicksBetweenPaths;
  due_ = due_ || ticks_ == 0 || (driving_ && stale(now));
}

bool PlannerNode::step(Micros now, Budget& budget, Outbox& out) {
  if (!due_ && !goal_changed_ && !must_replan()) return false;
  due_ = goal_changed_ = inputs_changed_ = false;
  publish(next_path(now, budget), out);
  return false;
}

/// The way that the robot follows no longer holds on the map, or for the pose, of now.
bool PlannerNode::must_replan() {
  if (!inputs_changed_) return false;
  inputs_changed_ = false;
  return plan_ && goal_.state() == GoalDesk::State::kActive &&
         !planner_.holds(*plan_, map_.map(), T_world_body_, goal_.goal());
}

path_t PlannerNode::next_path(Micros now, Budget& budget) {
  trouble_.clear();
  switch (goal_.state()) {
    case GoalDesk::State::kIdle:
      return stop_message(path_t::IDLE, "no goal");
    case GoalDesk::State::kCancelled:
      return stop_message(path_t::CANCELLED, "the goal was cancelled");
    case GoalDesk::State::kReached:
      return stop_message(path_t::REACHED, "the goal was reached");
    case GoalDesk::State::kActive:
      break;
  }
  if (auto message = stale(now)) {
    trouble_ = message->reason;
    return *std::move(message);
  }
  return plan(now, budget);
}

std::optional<path_t> PlannerNode::stale(Micros now) {
  if (!map_heard_) return stop_message(path_t::STALE_MAP, "no map was received yet");
  if (now - *map_heard_ > milliseconds(settings_.map_timeout_ms))
    return stop_message(path_t::STALE_MAP, "the mapper is silent");
  if (now - evidence_heard_ > evidence_timeout())
    return stop_message(path_t::STALE_MAP, "nothing new was seen for too long");
  if (!pose_heard_) return stop_message(path_t::STALE_POSE, "no pose was received yet");
  if (now - *pose_heard_ > milliseconds(settings_.pose_timeout_ms))
    return stop_message(path_t::STALE_POSE, "no new pose for too long");
  if (!surroundings_seen()) return stop_message(path_t::STALE_MAP, "no floor around the robot was seen yet");
  return std::nullopt;
}

/// True from the first free vertex near the robot on, until the map starts anew.
bool PlannerNode::surroundings_seen() {
  if (surroundings_seen_) return true;
  const auto here = T_world_body_.translation();
  const Lattice& lattice = map_.map().lattice();
  const CellIndex low =
      GridMap::tile_of(lattice.cell_of(here.x() - kSurroundings_m, here.y() - kSurroundings_m));
  const CellIndex high =
      GridMap::tile_of(lattice.cell_of(here.x() + kSurroundings_m, here.y() + kSurroundings_m));
  for (const auto& [index, tile] : map_.map().tiles()) {
    if (index.ix < low.ix || index.ix > high.ix || index.iy < low.iy || index.iy > high.iy) continue;
    surroundings_seen_ = surroundings_seen_ || tile->state.count(VertexState::kFree) > 0;
  }
  return surroundings_seen_;
}

Plan PlannerNode::plan_within(Budget& budget) {
  const Plan* const previous = plan_ ? &*plan_ : nullptr;
  return planner_.plan(
      map_.map(), T_world_body_, goal_.goal(), previous,
      [&] { return !budget.spend(kWorkBetweenInterrupts_ns); }, speed_.mps());
}

/// The robot has stood where known floor ends for long enough.
bool PlannerNode::looked_in_vain(const Plan& plan, Micros now) {
  if (plan.status != PlanStatus::kFrontier || plan.length_m > kAtFrontier_m) {
    at_frontier_since_.reset();
    return false;
  }
  if (!at_frontier_since_) at_frontier_since_ = now;
  return now - *at_frontier_since_ > milliseconds(1e3 * settings_.frontier_timeout_s);
}

void PlannerNode::open_all() {
  at_frontier_since_.reset();
  if (given_up_.empty()) return;
  given_up_.clear();
  planner_.shut_unknown({});
}

void PlannerNode::give_up_floor_ahead() {
  const auto here = T_world_body_.translation();
  given_up_.push_back({here.x(), here.y(), radius_m_ + kGivenUp_m});
  planner_.shut_unknown(given_up_);
  at_frontier_since_.reset();
}

path_t PlannerNode::plan(Micros now, Budget& budget) {
  Plan next = plan_within(budget);
  if (looked_in_vain(next, now)) {
    give_up_floor_ahead();
    next = plan_within(budget);
  }
  if (!given_up_.empty() && (next.status == PlanStatus::kNoPath || next.status == PlanStatus::kGoalBlocked)) {
    open_all();
    next = plan_within(budget);
  }
  if (next.status == PlanStatus::kInterrupted) {
    ++interrupted_;
    plan_.reset();
    return stop_message(path_t::NO_PATH, trouble_ = next.reason);
  }
  if (next.status == PlanStatus::kReached) goal_.reached();
  path_t message = to_message(next);
  if (next.route.corners.empty()) {
    if (next.status != PlanStatus::kReached) trouble_ = next.reason;
    plan_.reset();
  } else {
    plan_ = std::move(next);
  }
  return message;
}

void PlannerNode::publish(path_t message, Outbox& out) {
  driving_ = !message.points.empty();
  message.utime = pose_utime_us_;
  message.goal_id = goal_.id();
  message.map_epoch = map_.map().epoch;
  message.map_version = map_.map().version;
  message.valid_for_ms = static_cast<std::int32_t>(std::lround(settings_.valid_for_ms));
  out.publish(channel::kPath, std::move(message));
}

void PlannerNode::stop(Micros, Outbox& out) {
  publish(stop_message(path_t::IDLE, "the planner ends"), out);
}

void PlannerNode::report(health_t& health) const {
  add_drop(health, "POSE out of order", old_poses_);
  add_drop(health, "search out of time", interrupted_);
  if (!trouble_.empty()) worsen(health, health_t::DEGRADED, trouble_);
}

}  // namespace floornav
