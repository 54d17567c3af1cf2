#include <memory>
#include <string>

#include <CLI/CLI.hpp>

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
  MapFiles files;
  const DaemonInfo info{
      "floornav-mapper",
      "Remembers the floor: SURFELS, POSE, LOCAL_TO_GLOBAL and MAP_REQUEST in, GRID_MAP and TERRAIN_MAP out.",
      [&files](CLI::App& app) {
        app.add_option("--load", files.load, "begin with the map in this file")->type_name("FILE");
        app.add_option(
               "--save", files.save,
               "keep the map in this file; the same one as --load: it may be missing at the first run")
            ->type_name("FILE");
        app.add_option("--save-every", files.save_every_s, "seconds; it is saved at the end in any case")
            ->check(CLI::Range(1.0, 1e6))
            ->capture_default_str();
      }};
  return run_daemon<MapperProgramSettings>(argc, argv, info, [&files](const MapperProgramSettings& settings) {
    return std::make_unique<MapperNode>(settings.mapping, settings.robot, files);
  });
}
