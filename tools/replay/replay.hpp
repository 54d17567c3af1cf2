#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include <Eigen/Core>

#include "mapping/settings.hpp"
#include "perception/settings.hpp"
#include "planner/settings.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// The sections of a robot's file that a replay reads.
struct ReplaySettings {
  RobotSettings robot;
  PerceptionSettings perception;
  MappingSettings mapping;
  PlannerSettings planner;
};

template <class Visitor>
void visit_settings(Visitor& visit, ReplaySettings& s) {
  visit("robot", s.robot);
  visit("perception", s.perception);
  visit("mapping", s.mapping);
  visit("planner", s.planner);
}

/// What to replay.
struct ReplayRequest {
  std::filesystem::path log;
  std::filesystem::path out;  ///< folder; made where it is missing
  ReplaySettings settings;
  std::optional<Eigen::Vector2d> goal;  ///< m, local frame
  int threads = 1;
  std::optional<double> deadline_ms;  ///< of a frame, counted in estimated work
  bool salvage = false;               ///< replay what is whole of a damaged log
  bool frame_pictures = false;        ///< a picture for every frame
};

/// Called after each cloud of the log with how many there were and how many there are. False ends the replay
/// early.
using ReplayStep = std::function<bool(std::int64_t done, std::int64_t total)>;

/// Runs perception, mapper and planner over a log and writes every output. False where `step` ended it early:
/// the outputs are then those of what was replayed. Throws std::exception, one line, for a log that cannot be
/// replayed and for an output that cannot be written.
bool replay(const ReplayRequest& request, const ReplayStep& step);

}  // namespace floornav
