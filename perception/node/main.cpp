#include <memory>

#include "perception/node/perception_node.hpp"
#include "runtime/process/daemon.hpp"

namespace floornav {
namespace {

/// The sections of the robot's file that perception reads.
struct PerceptionProgramSettings {
  RobotSettings robot;
  PerceptionSettings perception;
};

template <class Visitor>
void visit_settings(Visitor& visit, PerceptionProgramSettings& s) {
  visit("robot", s.robot);
  visit("perception", s.perception);
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  using namespace floornav;
  const DaemonInfo info{
      "floornav-perception",
      "Finds the floor in depth clouds: KINECT_CLOUD, BUMBLEBEE_CLOUD and POSE in, SURFELS out."};
  return run_daemon<PerceptionProgramSettings>(
      argc, argv, info, [](const PerceptionProgramSettings& settings, Parallel& parallel) {
        return std::make_unique<PerceptionNode>(settings.perception, settings.robot, parallel);
      });
}
