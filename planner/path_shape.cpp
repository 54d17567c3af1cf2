#include "planner/path_shape.hpp"

#include <algorithm>
#include <cmath>

#include "planner/known_line.hpp"

namespace floornav {
namespace {

std::int32_t cell_index(double coordinate) {
  return static_cast<std::int32_t>(std::floor(coordinate));
}

GridPoint between(GridPoint a, GridPoint b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

class PathWriter {
 public:
  PathWriter(const PlanningGrid& grid, const GridMap& map, double z_m) : grid_(grid), map_(map), z_m_(z_m) {}

  void add(GridPoint p, double heading_rad) {
    PathPoint point{.x_m = grid_.x_of(p.x), .y_m = grid_.y_of(p.y), .heading_rad = heading_rad};
    const GridCell cell{cell_index(p.x + 0.5), cell_index(p.y + 0.5)};
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
    if (grid_.floor(cell) == Floor::kFree && tile != nullptr) {
      const std::int32_t vertex = GridTile::index_of(index);
      z_m_ = static_cast<double>(tile->height_m(vertex));
      point.slope_deg =
          static_cast<double>(GridTile::kSlopeUnit_deg) * tile->slope[static_cast<std::size_t>(vertex)];
    }
    point.z_m = z_m_;
  }

  const PlanningGrid& grid_;
  const GridMap& map_;
  double z_m_;
};

}  // namespace

DrivablePath drivable_path(const PlanningGrid& grid, const GridMap& map, const Route& route, double spacing_m,
                           double z_m) {
  PathWriter writer(grid, map, z_m);
  bool whole = true;
  for (std::size_t i = 1; i < route.corners.size() && whole; ++i) {
    const GridPoint a = route.corners[i - 1], b = route.corners[i];
    const double part = known_free_part(grid, a, b);
    whole = part == 1.0;
    const double heading_rad = std::atan2(b.y - a.y, b.x - a.x);
    const double length_m = part * std::hypot(b.x - a.x, b.y - a.y) * grid.pitch_m();
    if (length_m <= 0) continue;
    const int pieces = static_cast<int>(std::ceil(length_m / spacing_m));
    // A corner belongs to the line that leaves it.
    if (!writer.points.empty()) writer.points.back().heading_rad = heading_rad;
    for (int k = writer.points.empty() ? 0 : 1; k <= pieces; ++k)
      writer.add(between(a, b, part * k / pieces), heading_rad);
  }
  return {std::move(writer.points), writer.length_m, whole};
}

}  // namespace floornav
