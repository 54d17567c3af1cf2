#include <memory>

#include "planner/node/planner_node.hpp"
#include "runtime/process/daemon.hpp"

namespace floornav {
namespace {

/// The sections of the robot's file that the planner reads.
struct PlannerProgramSettings {
  RobotSettings robot;
  PlannerSettings planner;
};

template <class Visitor>
void visit_settings(Visitor& visit, PlannerProgramSettings& s) {
  visit("robot", s.robot);
  visit("planner", s.planner);
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  using namespace floornav;
  const DaemonInfo info{"floornav-planner",
                        "Plans the way to the goal: GRID_MAP, POSE and GOAL in, PATH out."};
  return run_daemon<PlannerProgramSettings>(argc, argv, info, [](const PlannerProgramSettings& settings) {
    return std::make_unique<PlannerNode>(settings.planner, settings.robot);
  });
}
