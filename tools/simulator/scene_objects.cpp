#include "tools/simulator/scene_objects.hpp"

#include <array>
#include <string>
#include <vector>

#include "tools/simulator/portable_math.hpp"

namespace floornav {
namespace {

constexpr Allowed kSize{0.001, 1000.0};
constexpr Allowed kThickness{0.001, 10.0};
constexpr Allowed kHeight{-10.0, 10.0};
constexpr Allowed kAngle{-360.0, 360.0};

Footprint read_footprint(SceneSection& s, std::size_t size_numbers, double* third = nullptr) {
  Footprint footprint;
  footprint.center_m = s.point("center_m");
  const std::vector<double> size = s.numbers("size_m", size_numbers, kSize);
  footprint.half_m = Eigen::Vector2d(0.5 * size[0], 0.5 * size[1]);
  if (third != nullptr) *third = size[2];
  const SinCos turn = sin_cos_deg(s.number_or("yaw_deg", 0.0, kAngle));
  footprint.axis = {turn.cos, turn.sin};
  return footprint;
}

Footprint strip(SceneSection& s, double width_m) {
  const Eigen::Vector2d from = s.point("from_m");
  const Eigen::Vector2d to = s.point("to_m");
  const double length = (to - from).norm();
  if (length < 0.001) s.refuse("to_m", "is the same place as from_m");
  return {0.5 * (from + to), (to - from) / length, {0.5 * length, 0.5 * width_m}};
}

void read_box(SceneSection& s, Scene& scene) {
  double height = 0;
  Block block;
  block.footprint = read_footprint(s, 3, &height);
  block.bottom_m = s.number_or("bottom_m", 0.0, kHeight);
  block.top_m = block.bottom_m + height;
  scene.fixed.blocks.push_back(block);
}

void read_ramp(SceneSection& s, Scene& scene) {
  Block block;
  block.footprint = read_footprint(s, 2);
  block.bottom_m = s.number_or("bottom_m", 0.0, kHeight);
  const double from = s.number_or("from_height_m", 0.0, Allowed{0.0, 10.0});
  const double to = s.number("to_height_m", Allowed{0.0, 10.0});
  block.top_m = block.bottom_m + 0.5 * (from + to);
  block.slope.x() = (to - from) / (2.0 * block.footprint.half_m.x());
  scene.fixed.blocks.push_back(block);
}

void read_wall(SceneSection& s, Scene& scene) {
  Block block;
  block.footprint = strip(s, s.number_or("thickness_m", 0.1, kThickness));
  block.bottom_m = s.number_or("bottom_m", 0.0, kHeight);
  block.top_m = block.bottom_m + s.number("height_m", kThickness);
  scene.fixed.blocks.push_back(block);
}

void read_join(SceneSection& s, Scene& scene) {
  Block block;
  block.footprint = strip(s, s.number("width_m", Allowed{0.001, 1.0}));
  block.top_m = s.number("height_m", Allowed{0.0005, 0.1});
  scene.fixed.blocks.push_back(block);
}

void read_cylinder(SceneSection& s, Scene& scene) {
  Cylinder cylinder;
  cylinder.center_m = s.point("center_m");
  cylinder.radius_m = s.number("radius_m", Allowed{0.002, 100.0});
  cylinder.bottom_m = s.number_or("bottom_m", 0.0, kHeight);
  cylinder.top_m = cylinder.bottom_m + s.number("height_m", kThickness);
  scene.fixed.cylinders.push_back(cylinder);
}

void read_table(SceneSection& s, Scene& scene) {
  double height = 0;
  Block top;
  top.footprint = read_footprint(s, 3, &height);
  const double thickness = s.number_or("thickness_m", 0.03, kThickness);
  const double leg_radius = s.number_or("leg_radius_m", 0.02, Allowed{0.002, 1.0});
  if (thickness >= height) s.refuse("thickness_m", "must be less than the table's height");
  top.top_m = height;
  top.bottom_m = height - thickness;
  const Eigen::Vector2d corner = top.footprint.half_m.array() - leg_radius;
  if (corner.minCoeff() <= leg_radius) s.refuse("leg_radius_m", "leaves no room between the legs");
  for (const double x : {-corner.x(), corner.x()})
    for (const double y : {-corner.y(), corner.y()})
      scene.fixed.cylinders.push_back({top.footprint.world({x, y}), leg_radius, 0.0, top.bottom_m});
  scene.fixed.blocks.push_back(top);
}

void read_carpet(SceneSection& s, Scene& scene) {
  Waves waves;
  waves.footprint = read_footprint(s, 2);
  waves.base_m = s.number_or("bottom_m", 0.0, kHeight);
  waves.amplitude_m = s.number("amplitude_m", Allowed{0.0005, 0.2});
  waves.count = s.whole_number("waves", Allowed{1, 1000});
  scene.fixed.waves.push_back(waves);
}

void read_drop(SceneSection& s, Scene& scene) {
  Hole hole;
  hole.footprint = read_footprint(s, 2);
  hole.bottom_m = scene.fixed.ground.z_m(hole.footprint.center_m) - s.number("depth_m", Allowed{0.001, 10.0});
  scene.fixed.holes.push_back(hole);
}

/// A pit whose treads go down along its own x axis; the last tread is the pit's bottom.
void read_stairs_down(SceneSection& s, Scene& scene) {
  Hole hole;
  hole.footprint = read_footprint(s, 2);
  const int steps = s.whole_number("steps", Allowed{1, 50});
  const double rise = s.number("rise_m", Allowed{0.005, 0.5});
  const double floor = scene.fixed.ground.z_m(hole.footprint.center_m);
  hole.bottom_m = floor - steps * rise;
  const double run = 2.0 * hole.footprint.half_m.x() / steps;
  for (int i = 0; i + 1 < steps; ++i) {
    Block tread;
    tread.footprint = hole.footprint;
    tread.footprint.half_m.x() = 0.5 * run;
    tread.footprint.center_m = hole.footprint.world({-hole.footprint.half_m.x() + (i + 0.5) * run, 0.0});
    tread.bottom_m = hole.bottom_m;
    tread.top_m = floor - (i + 1) * rise;
    scene.fixed.blocks.push_back(tread);
  }
  scene.fixed.holes.push_back(hole);
}

void read_person(SceneSection& s, Scene& scene) {
  Person person;
  person.from_m = s.point("from_m");
  person.to_m = s.point("to_m");
  if ((person.to_m - person.from_m).norm() < 0.1) s.refuse("to_m", "is less than 0.1 m from from_m");
  person.speed_mps = s.number_or("speed_mps", person.speed_mps, Allowed{0.0, 5.0});
  person.height_m = s.number_or("height_m", person.height_m, Allowed{0.5, 2.5});
  person.start_s = s.number_or("start_s", 0.0, Allowed{0.0, 100000.0});
  scene.people.push_back(person);
}

struct Kind {
  const char* name;
  void (*read)(SceneSection&, Scene&);
};
constexpr std::array<Kind, 10> kKinds{{{"box", read_box},
                                       {"ramp", read_ramp},
                                       {"wall", read_wall},
                                       {"join", read_join},
                                       {"cylinder", read_cylinder},
                                       {"table", read_table},
                                       {"carpet", read_carpet},
                                       {"drop", read_drop},
                                       {"stairs_down", read_stairs_down},
                                       {"person", read_person}}};

}  // namespace

void read_object(SceneSection& object, Scene& scene) {
  const std::string name = object.only_key();
  std::string known;
  for (const Kind& kind : kKinds) {
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
    if (name != kind.name) continue;
    SceneSection s = object.section(name);
    kind.read(s, scene);
    s.finish();
    return;
  }
  object.refuse(name, "unknown kind of object, allowed are: " + known);
}

}  // namespace floornav
