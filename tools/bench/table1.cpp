#include "tools/bench/table1.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tools/bench/frame_stack.hpp"
#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

constexpr double kVertex_m = 0.1;
constexpr double kNear_m = 3.0;
constexpr double kFloorRange_m = 6.0;
constexpr int kBlockMatchingWindow_px = 9;

struct Grid {
  int x_res;
  int y_res;
};
constexpr std::array<Grid, 4> kGrids{{{3, 2}, {4, 3}, {8, 6}, {12, 9}}};

constexpr std::array<std::array<PaperRow, 4>, 2> kPaper{{
    {{{0.51, 5.31}, {0.44, 4.97}, {0.44, 4.88}, {0.40, 4.74}}},
    {{{0.39, 2.49}, {0.31, 2.21}, {0.32, 2.10}, {0.29, 1.99}}},
}};

CoveredArea area_of(SensorKind sensor) {
  return sensor == SensorKind::kKinect ? CoveredArea{5.5, 3.0} : CoveredArea{6.0, 4.2};
}

PerceptionSettings perception_of(SensorKind sensor, const Grid& grid) {
  const CoveredArea area = area_of(sensor);
  PerceptionSettings settings;
  settings.roi.x_max_m = area.length_m;
  settings.roi.y_min_m = -0.5 * area.width_m;
  settings.roi.y_max_m = 0.5 * area.width_m;
  settings.sections = {grid.x_res, grid.y_res};
  return settings;
}

bool within(const Footprint& footprint, const Eigen::Vector2d& place, double margin_m) {
  const Eigen::Vector2d local = footprint.local(place).cwiseAbs();
  return local.x() <= footprint.half_m.x() + margin_m && local.y() <= footprint.half_m.y() + margin_m;
}

/// Calls visit(place, height) for every vertex that was seen.
template <class Visit>
void visit_vertices(const GridMap& map, const Visit& visit) {
  for (const CellIndex tile_index : map.sorted_tiles()) {
    const GridTile& tile = *map.find(tile_index);
    for (std::int32_t i = 0; i < GridTile::kVertices; ++i) {
      if (tile.state[static_cast<std::size_t>(i)] == VertexState::kUnknown) continue;
      const std::int32_t ix = tile_index.ix * GridTile::kSide + i % GridTile::kSide;
      const std::int32_t iy = tile_index.iy * GridTile::kSide + i / GridTile::kSide;
      visit(Eigen::Vector2d(map.lattice().center_of(ix), map.lattice().center_of(iy)),
            static_cast<double>(tile.height_m(i)));
    }
  }
}

void judge(const ObstacleCourse& course, const GridMap& map, Table1Row& row) {
  // a vertex stands for a cell around its centre: the cells that touch the footprint, and one around
  const double reach_m = 1.5 * kVertex_m;
  std::vector<double> highest(course.obstacles.size(), 0.0);
  const Eigen::Vector2d robot = course.T_world_body.translation().head<2>();
  visit_vertices(map, [&](const Eigen::Vector2d& place, double z_m) {
    bool on_floor = (place - robot).norm() <= kFloorRange_m;
    for (std::size_t i = 0; i < course.obstacles.size(); ++i) {
      if (!within(course.obstacles[i].footprint, place, reach_m)) continue;
      on_floor = false;
      highest[i] = std::max(highest[i], z_m);
    }
    if (!on_floor) return;
    row.floor_square_m2 += z_m * z_m;
    ++row.floor_vertices;
  });
  for (std::size_t i = 0; i < course.obstacles.size(); ++i) {
    const Obstacle& obstacle = course.obstacles[i];
    (obstacle.distance_m < kNear_m ? row.near : row.far).add(highest[i], obstacle.height_m);
    (obstacle.sloped ? row.sloped : row.flat).add(highest[i], obstacle.height_m);
  }
}

void measure(SensorKind kind, bool correlated, int configurations, std::uint64_t seed,
             std::vector<Table1Row>& rows) {
  SensorSpec model = kind == SensorKind::kKinect ? kinect() : bumblebee();
  if (correlated) model.noise.correlation_px = kBlockMatchingWindow_px;
  for (int number = 0; number < configurations; ++number) {
    const std::uint64_t key = random_key({seed, static_cast<std::uint64_t>(number)});
    const ObstacleCourse course = random_course(model, area_of(kind), key);
    DepthSensor sensor(model, key);
    const auto pixels = sensor.measure(course.shapes, course.T_world_body, 0);
    for (std::size_t i = 0; i < kGrids.size(); ++i) {
      MappingSettings mapping;
      mapping.resolution_m = kVertex_m;
      FrameStack stack(perception_of(kind, kGrids[i]), mapping, RobotSettings{});
      stack.see(sensor, pixels, course.T_world_body);
      judge(course, stack.published(), rows[rows.size() - kGrids.size() + i]);
    }
  }
}

}  // namespace

void HeightErrors::add(double found_m, double true_m) {
  const bool is_missed = found_m < 0.5 * true_m;
  const double error_m = is_missed ? true_m : std::fabs(found_m - true_m);
  ++count;
  missed += is_missed ? 1 : 0;
  sum_m += error_m;
  worst_m = std::max(worst_m, error_m);
}

PaperRow paper_row(SensorKind sensor, int x_res, int y_res) {
  for (std::size_t i = 0; i < kGrids.size(); ++i)
    if (kGrids[i].x_res == x_res && kGrids[i].y_res == y_res)
      return kPaper[sensor == SensorKind::kKinect ? 0 : 1][i];
  return {};
}

std::vector<Table1Row> measure_table1(int configurations, std::uint64_t seed,
                                      const std::function<void(const std::string&)>& progress) {
  std::vector<Table1Row> rows;
  for (const SensorKind sensor : {SensorKind::kKinect, SensorKind::kBumblebee}) {
    for (const bool correlated : {false, true}) {
      progress(fmt::format("{}, {} noise: {} configurations",
                           sensor == SensorKind::kKinect ? "Kinect" : "Bumblebee",
                           correlated ? "correlated" : "independent", configurations));
      for (const Grid& grid : kGrids) {
        rows.emplace_back();
        rows.back().sensor = sensor;
        rows.back().x_res = grid.x_res;
        rows.back().y_res = grid.y_res;
        rows.back().correlated = correlated;
      }
      measure(sensor, correlated, configurations, seed, rows);
    }
  }
  return rows;
}

}  // namespace floornav
