#include "planner/path_shape.hpp"

#include <algorithm>
#include <cmath>

#include "planner/clear_way.hpp"
#include "planner/rounding.hpp"
#include "planner/surface_profile.hpp"

namespace floornav {
namespace {

GridPoint between(GridPoint a, GridPoint b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

class PathWriter {
 public:
  PathWriter(const PlanningGrid& grid, const GridMap& map, double track_m, double z_m)
      : grid_(grid), map_(map), track_m_(track_m), z_m_(z_m) {}

  void add(GridPoint p, double heading_rad) {
    PathPoint point{.x_m = grid_.x_of(p.x), .y_m = grid_.y_of(p.y), .heading_rad = heading_rad};
    const GridCell cell = cell_at(p);
    read_terrain(cell, point);
    point.clearance_m = grid_.clearance_m(cell);
    point.assumed = grid_.floor(cell) == Floor::kAssumed;
    if (!points.empty()) length_m += std::hypot(point.x_m - points.back().x_m, point.y_m - points.back().y_m);
    points.push_back(point);
  }

  std::vector<PathPoint> points;
  double length_m = 0;

 private:
  /// Where the map knows no height, that of the point before.
  void read_terrain(GridCell cell, PathPoint& point) {
    const CellIndex index{cell.x + grid_.origin().ix, cell.y + grid_.origin().iy};
    const GridTile* const tile = map_.find(GridMap::tile_of(index));
    if (grid_.floor(cell) == Floor::kFree && tile != nullptr)
      z_m_ = static_cast<double>(tile->height_m(GridTile::index_of(index)));
    point.z_m = z_m_;
    const SurfaceProfile surface = surface_profile(map_, point.x_m, point.y_m, point.heading_rad, track_m_);
    point.slope_deg = surface.slope_deg;
    point.step_m = surface.step_m;
    point.roughness_m = surface.roughness_m;
  }

  const PlanningGrid& grid_;
  const GridMap& map_;
  double track_m_;
  double z_m_;
};

/// The route as far as it is known to be free, turns included; its way out may lie in the inflation of an
/// obstacle.
std::vector<GridPoint> known_corners(const PlanningGrid& grid, const Route& route, double heading_rad,
                                     bool& whole) {
  std::vector<GridPoint> corners{route.corners.front()};
  whole = true;
  for (std::size_t i = 1; i < route.corners.size() && whole; ++i) {
    const GridPoint a = route.corners[i - 1], b = route.corners[i];
    if (a == b) continue;
    const double next_rad = std::atan2(b.y - a.y, b.x - a.x);
    double part = 1.0;
    if (i > route.way_out)
      part = turn_clear(grid, a, heading_rad, next_rad, Avoid::kBlockedAndUnknown)
                 ? known_free_part(grid, a, b)
                 : 0.0;
    whole = part == 1.0;
    if (part > 0) corners.push_back(between(a, b, part));
    heading_rad = next_rad;
  }
  return corners;
}

}  // namespace

DrivablePath drivable_path(const PlanningGrid& grid, const GridMap& map, const Route& route,
                           const RobotSettings& robot, double spacing_m, const Pose& T_world_body) {
  bool whole = false;
  const std::vector<GridPoint> corners = known_corners(grid, route, heading_of(T_world_body), whole);
  const double radius = robot.max_speed_mps / robot.max_turn_rate_radps / grid.pitch_m();
  const std::size_t fixed = std::min(route.way_out, corners.size() - 1);
  const std::vector<GridPoint> line = rounded(grid, corners, fixed, radius);
  std::size_t way_out_points = 0;
  PathWriter writer(grid, map, robot.track_m, T_world_body.translation().z());
  for (std::size_t i = 1; i < line.size(); ++i) {
    const GridPoint a = line[i - 1], b = line[i];
    const double length_m = std::hypot(b.x - a.x, b.y - a.y) * grid.pitch_m();
    if (i == fixed + 1 && fixed > 0) way_out_points = writer.points.size();
    if (length_m <= 0) continue;
    const double heading_rad = std::atan2(b.y - a.y, b.x - a.x);
    const int pieces = static_cast<int>(std::ceil(length_m / spacing_m));
    // A corner belongs to the line that leaves it.
    if (!writer.points.empty()) writer.points.back().heading_rad = heading_rad;
    for (int k = writer.points.empty() ? 0 : 1; k <= pieces; ++k)
      writer.add(between(a, b, static_cast<double>(k) / pieces), heading_rad);
  }
  if (fixed > 0 && way_out_points == 0) way_out_points = writer.points.size();
  return {std::move(writer.points), writer.length_m, way_out_points, whole};
}

}  // namespace floornav
