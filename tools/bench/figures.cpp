#include "tools/bench/figures.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/bench/bench_scene.hpp"
#include "tools/bench/frame_stack.hpp"
#include "tools/bench/table1.hpp"
#include "tools/pictures/frame_picture.hpp"
#include "tools/pictures/terrain_picture.hpp"
#include "tools/simulator/scene_file.hpp"
#include "tools/simulator/trajectory.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

constexpr double kFramePeriod_s = 0.1;

FramePicture picture_of(const DepthSensor& sensor, std::span<const std::uint16_t> pixels,
                        const GridMap& map) {
  const SensorSpec& spec = sensor.model();
  FramePicture picture;
  picture.image_width = spec.camera.width;
  picture.image_height = spec.camera.height;
  picture.pixels.reserve(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto column = static_cast<float>(i % static_cast<std::size_t>(spec.camera.width));
    const auto row = static_cast<float>(i / static_cast<std::size_t>(spec.camera.width));
    const double depth_m = pixels[i] * sensor.unit();
    const Eigen::Vector3d p = spec.T_body_sensor * (depth_m * spec.camera.ray(column, row).cast<double>());
    picture.pixels.push_back(pixel_color(depth_m, map.state(map.lattice().cell_of(p.x(), p.y()))));
  }
  picture.map = rasterize(map);
  picture.robot = RobotMark{{0, 0}, 0.0, RobotSettings{}.radius_m};
  return picture;
}

}  // namespace

std::vector<std::filesystem::path> draw_figure_1(const std::filesystem::path& folder) {
  DepthSensor sensor(kinect(), 1);
  const auto pixels = sensor.measure(bench_scene(), Pose::Identity(), 0);
  std::vector<std::filesystem::path> files;
  for (const double resolution_m : {0.1, 0.2, 0.3}) {
    MappingSettings mapping;
    mapping.resolution_m = resolution_m;
    FrameStack stack(PerceptionSettings{}, mapping, RobotSettings{});
    for (int frame = 0; frame < 3; ++frame) stack.see(sensor, pixels, Pose::Identity());
    FramePicture picture = picture_of(sensor, pixels, stack.published());
    picture.title = fmt::format("Figure 1: the test bed and its grid-map of {} m", resolution_m);
    picture.subtitle = "a step of 1 cm, a ramp of 5 degrees, boxes of 5 to 40 cm, a wall";
    files.push_back(folder / fmt::format("figure1_{}m.png", resolution_m));
    write_frame_png(picture, files.back());
  }
  return files;
}

std::vector<std::filesystem::path> draw_figure_7(const std::filesystem::path& scene_file,
                                                 const std::filesystem::path& folder) {
  const Scene scene = load_scene(scene_file.string());
  if (!scene.drive) throw std::invalid_argument(scene_file.string() + ": drive: this scene has none");
  const RobotSettings robot;
  DepthSensor sensor(kinect(320), 1);
  FrameStack stack(PerceptionSettings{}, MappingSettings{}, robot);
  TerrainPicture picture;
  const Trajectory trajectory(*scene.drive, robot.max_acceleration_mps2);
  int frames = 0;
  for (double time_s = 0; time_s < trajectory.duration_s(); time_s += kFramePeriod_s, ++frames) {
    const Pose T_world_body = body_on_floor(scene.fixed, trajectory.at(time_s));
    stack.see(sensor, sensor.measure(scene.at(time_s), T_world_body, frames), T_world_body);
    picture.trajectory.push_back(T_world_body.translation().head<2>());
  }
  picture.terrain = rasterize(stack.terrain());
  picture.title = "Figure 7: the terrain map of " + scene.name;
  picture.subtitle =
      fmt::format("{} frames of a Kinect, cells of {} m", frames, stack.terrain().lattice().pitch_m);
  const std::filesystem::path file = folder / "figure7.png";
  write_terrain_png(picture, file);
  return {file};
}

}  // namespace floornav
