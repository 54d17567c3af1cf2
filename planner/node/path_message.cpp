#include "planner/node/path_message.hpp"

#include <stdexcept>

namespace floornav {
namespace {

std::int8_t to_message(PlanStatus status) {
  switch (status) {
    case PlanStatus::kFollowing:
      return path_t::FOLLOWING;
    case PlanStatus::kReached:
      return path_t::REACHED;
    case PlanStatus::kFrontier:
      return path_t::FRONTIER;
    case PlanStatus::kNoPath:
      return path_t::NO_PATH;
    case PlanStatus::kStartBlocked:
      return path_t::START_BLOCKED;
    case PlanStatus::kGoalBlocked:
      return path_t::GOAL_BLOCKED;
    case PlanStatus::kInterrupted:
      break;
  }
  throw std::logic_error("an interrupted search makes no path message");
}

}  // namespace

path_t to_message(const Plan& plan) {
  path_t message{};
  message.status = to_message(plan.status);
  message.reason = plan.reason;
  message.map_epoch = plan.map_epoch;
  message.map_version = plan.map_version;
  message.length = static_cast<float>(plan.length_m);
  message.n_points = static_cast<std::int32_t>(plan.points.size());
  message.points.reserve(plan.points.size());
  for (const PathPoint& p : plan.points) {
    path_point_t point{};
    point.x = static_cast<float>(p.x_m);
    point.y = static_cast<float>(p.y_m);
    point.z = static_cast<float>(p.z_m);
    point.heading = static_cast<float>(p.heading_rad);
    point.speed = static_cast<float>(p.speed_mps);
    point.clearance = static_cast<float>(p.clearance_m);
    point.assumed = p.assumed ? 1 : 0;
    message.points.push_back(point);
  }
  return message;
}

}  // namespace floornav
