#include "tools/simulate/run_picture.hpp"

#include <cmath>
#include <vector>

#include "tools/pictures/map_picture.hpp"
#include "tools/simulator/portable_math.hpp"

namespace floornav {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

Outline outline_of(const Footprint& footprint) {
  Outline corners;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {-1, -1}})
    corners.push_back(footprint.world(footprint.half_m.cwiseProduct(Eigen::Vector2d(x, y))));
  return corners;
}

Outline outline_of(const Cylinder& cylinder) {
  Outline circle;
  for (int i = 0; i <= 24; ++i) {
    const SinCos turn = sin_cos_deg(15.0 * i);
    circle.push_back(cylinder.center_m + cylinder.radius_m * Eigen::Vector2d(turn.cos, turn.sin));
  }
  return circle;
}

}  // namespace

void write_run_picture(const RandomWorld& world, const RobotSettings& robot, const RunRecord& record,
                       const std::string& title, const std::filesystem::path& file) {
  MapPicture picture;
  picture.map = rasterize(record.map.map());
  picture.trajectory = record.driven_m;
  picture.path = record.path_m;
  picture.robot = RobotMark{record.end.position_m, std::atan2(record.end.ahead.y(), record.end.ahead.x()),
                            robot.radius_m};
  picture.goal = world.scene.goal_m;
  for (const Block& block : world.scene.fixed.blocks)
    picture.true_outlines.push_back(outline_of(block.footprint));
  for (const Hole& hole : world.scene.fixed.holes)
    picture.true_outlines.push_back(outline_of(hole.footprint));
  for (const Cylinder& cylinder : world.scene.fixed.cylinders)
    picture.true_outlines.push_back(outline_of(cylinder));
  for (const Person& person : world.scene.people)
    picture.true_outlines.push_back({person.from_m, person.to_m});
  picture.title = world.scene.name;
  picture.subtitle = title;
  write_map_png(picture, file);
}

}  // namespace floornav
