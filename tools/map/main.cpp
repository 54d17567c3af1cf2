#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "mapping/node/map_file.hpp"
#include "mapping/roadmap.hpp"
#include "mapping/world_map.hpp"
#include "runtime/process/settings_reader.hpp"
#include "tools/pictures/map_picture.hpp"
#include "tools/pictures/terrain_picture.hpp"
#include "tools/replay/map_files.hpp"

namespace floornav {
namespace {

/// The sections of the robot's file that judge a map.
struct MapProgramSettings {
  RobotSettings robot;
  MappingSettings mapping;
};

template <class Visitor>
void visit_settings(Visitor& visit, MapProgramSettings& s) {
  visit("robot", s.robot);
  visit("mapping", s.mapping);
}

struct Request {
  std::filesystem::path file;
  std::filesystem::path config;
  std::filesystem::path out;
};

void write_pictures(const Request& request, const MapProgramSettings& settings, const WorldMap& world,
                    const MapRaster& raster) {
  const Roadmap roadmap = make_roadmap(world.grid(), settings.robot.radius_m);
  MapPicture picture;
  picture.map = raster;
  picture.title = request.file.filename().string();
  double ways_m = 0;
  for (const Roadmap::Way& way : roadmap.ways) {
    picture.roads.push_back(way.places_m);
    ways_m += way.length_m;
  }
  picture.subtitle = fmt::format("roadmap of {} ways, {:.1f} m, {} m from everything", roadmap.ways.size(),
                                 ways_m, settings.robot.radius_m);
  write_map_png(picture, request.out / "roadmap.png");
  TerrainPicture terrain;
  terrain.terrain = rasterize(world.terrain());
  terrain.title = picture.title;
  terrain.subtitle = fmt::format("terrain, cells of {} m", world.terrain().lattice().pitch_m);
  write_terrain_png(terrain, request.out / "terrain.png");
}

void export_map(const Request& request) {
  MapProgramSettings settings;
  if (!request.config.empty()) read_robot_file(request.config, settings);
  const MapMemory memory = load_map(request.file);
  WorldMap world(settings.mapping, settings.robot);
  world.restore(memory);
  const MapRaster raster = rasterize(world.grid());
  const auto count = [&](VertexState state) { return std::ranges::count(raster.state, state); };
  const double cell_m2 = raster.cells.resolution_m * raster.cells.resolution_m;
  fmt::print("{}: {:.1f} m2 free, {:.1f} m2 blocked, {} tiles, {} bytes\n", request.file.string(),
             cell_m2 * static_cast<double>(count(VertexState::kFree)),
             cell_m2 * static_cast<double>(count(VertexState::kBlocked)), memory.tiles.size(),
             std::filesystem::file_size(request.file));
  if (request.out.empty()) return;
  std::filesystem::create_directories(request.out);
  write_map_files(raster, request.out);
  write_pictures(request, settings, world, raster);
}

int run_program(int argc, char** argv) {
  CLI::App app("Reads a map that floornav-mapper --save has kept", "floornav-map");
  app.footer(
      "Examples:\n"
      "  floornav-map house.map                     what it holds\n"
      "  floornav-map house.map --out house/        map.yaml, map.pgm (map_server), belief.tiff, "
      "height.tiff,\n"
      "                                             roadmap.png, terrain.png");
  Request request;
  app.add_option("FILE", request.file, "the map")->required();
  app.add_option("--out", request.out, "folder for the export")->type_name("DIR");
  app.add_option("--config", request.config, "YAML file of the robot that judges it")->type_name("FILE");
  CLI11_PARSE(app, argc, argv);
  export_map(request);
  return 0;
}

}  // namespace
}  // namespace floornav

int main(int argc, char** argv) {
  try {
    return floornav::run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "floornav-map: {}\n", error.what());
    return 1;
  }
}
