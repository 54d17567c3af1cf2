#include "tools/simulator/scene_file.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tools/simulator/scene_objects.hpp"

namespace floornav {
namespace {

/// Rectangles overlap unless an axis of one of them separates them.
bool overlap(const Footprint& a, const Footprint& b) {
  for (const Footprint* f : {&a, &b}) {
    for (const Eigen::Vector2d& axis : {f->axis, Eigen::Vector2d(-f->axis.y(), f->axis.x())}) {
      const auto reach = [&axis](const Footprint& r) {
        return std::fabs(r.axis.dot(axis)) * r.half_m.x() +
               std::fabs(r.axis.x() * axis.y() - r.axis.y() * axis.x()) * r.half_m.y();
      };
      if (std::fabs((a.center_m - b.center_m).dot(axis)) >= reach(a) + reach(b) - 1e-9) return false;
    }
  }
  return true;
}

void check_holes(const SceneSection& file, const Shapes& shapes) {
  for (std::size_t i = 0; i < shapes.holes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (overlap(shapes.holes[i].footprint, shapes.holes[k].footprint))
        file.refuse("objects", "two drops or stairs_down overlap");
}

Scene read_scene(SceneSection& file) {
  Scene scene;
  scene.name = file.text("name");
  const std::vector<double> area = file.numbers("area_m", 4, Allowed{-1000.0, 1000.0});
  scene.area_min_m = {area[0], area[1]};
  scene.area_max_m = {area[2], area[3]};
  if ((scene.area_max_m - scene.area_min_m).minCoeff() < 0.1)
    file.refuse("area_m", "must be [x_min, y_min, x_max, y_max], at least 0.1 m wide each way");
  if (file.has("ground")) {
    SceneSection ground = file.section("ground");
    const std::vector<double> slope = ground.numbers("slope", 2, Allowed{-0.5, 0.5});
    scene.fixed.ground.slope = {slope[0], slope[1]};
    ground.finish();
  }
  for (SceneSection& object : file.sections("objects")) read_object(object, scene);
  check_holes(file, scene.fixed);
  if (file.has("drive")) {
    SceneSection drive = file.section("drive");
    scene.drive.emplace();
    scene.drive->waypoints_m = drive.points("waypoints_m", 4);
    scene.drive->speed_mps = drive.number_or("speed_mps", scene.drive->speed_mps, Allowed{0.01, 5.0});
    drive.finish();
  }
  if (file.has("goal_m")) scene.goal_m = file.point("goal_m");
  return scene;
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name) {
  try {
    SceneSection file(name, "", YAML::Load(text));
    Scene scene = read_scene(file);
    file.finish();
    return scene;
  } catch (const YAML::Exception& e) {
    const std::string line = e.mark.is_null() ? "" : ":" + std::to_string(e.mark.line + 1);
    throw SceneError(name + line + ": not YAML: " + e.msg);
  }
}

Scene load_scene(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw SceneError(path + ": cannot be opened");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw SceneError(path + ": cannot be read");
  return parse_scene(text, path);
}

}  // namespace floornav
