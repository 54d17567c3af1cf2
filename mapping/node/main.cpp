#include <memory>

#include "mapping/node/mapper_node.hpp"
#include "runtime/process/daemon.hpp"

namespace floornav {
namespace {

/// The sections of the robot's file that the mapper reads.
struct MapperProgramSettings {
  RobotSettings robot;
  MappingSettings mapping;
};

template <class Visitor>
void visit_settings(Visitor& visit, MapperProgramSettings& s) {
  visit("robot", s.robot);
  visit("mapping", s.mapping);
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  using namespace floornav;
  const DaemonInfo info{
      "floornav-mapper",
      "Remembers the floor: SURFELS, POSE and MAP_REQUEST in, GRID_MAP and TERRAIN_MAP out."};
  return run_daemon<MapperProgramSettings>(argc, argv, info, [](const MapperProgramSettings& settings) {
    return std::make_unique<MapperNode>(settings.mapping, settings.robot);
  });
}
