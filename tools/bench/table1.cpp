#include "tools/bench/table1.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "tools/bench/frame_stack.hpp"
#include "tools/bench/matched_pairs.hpp"
#include "tools/bench/sensor_names.hpp"
#include "tools/simulator/messages.hpp"
#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

constexpr double kVertex_m = 0.1;
constexpr double kNear_m = 3.0;
constexpr double kFloorRange_m = 6.0;
constexpr int kBlockMatchingWindow_px = 9;

constexpr std::size_t kRows = 5;
/// The paper's four, and its eq. (5).
std::array<SectionSettings, kRows> section_rows() {
  return {{{3, 2}, {4, 3}, {8, 6}, {12, 9}, {.x_res = 4, .y_res = 3, .layout = "error_growth"}}};
}

constexpr std::array<std::array<PaperRow, 4>, 2> kPaper{{
    {{{0.51, 5.31}, {0.44, 4.97}, {0.44, 4.88}, {0.40, 4.74}}},
    {{{0.39, 2.49}, {0.31, 2.21}, {0.32, 2.10}, {0.29, 1.99}}},
}};

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

using Rows = std::array<Table1Row, kRows>;

/// The rows of all ways to cut sections for a cloud of a course.
Rows measure(SensorKind kind, const ObstacleCourse& course, const depth_cloud_t& cloud) {
  const auto sections = section_rows();
  Rows rows;
  for (std::size_t i = 0; i < kRows; ++i) {
    rows[i].sensor = kind;
    rows[i].x_res = sections[i].x_res;
    rows[i].y_res = sections[i].y_res;
    rows[i].error_growth = sections[i].layout == "error_growth";
    MappingSettings mapping;
    mapping.resolution_m = kVertex_m;
    FrameStack stack(perception_for(kind, sections[i]), mapping, RobotSettings{});
    stack.see(cloud, course.T_world_body);
    judge(course, stack.published(), rows[i]);
  }
  return rows;
}

Rows measure_simulated(SensorKind kind, bool correlated, std::uint64_t key) {
  const SensorSpec model = bench_sensor(kind, correlated);
  const ObstacleCourse course = random_course(model, covered_area(kind), key);
  DepthSensor sensor(model, key);
  const auto pixels = sensor.measure(course.shapes, course.T_world_body, 0);
  Rows rows = measure(kind, course, cloud_message(sensor, pixels, 0, 0));
  for (Table1Row& row : rows) row.correlated = correlated;
  return rows;
}

/// Appends the sums of many configurations' rows.
void append(const std::vector<Rows>& measured, std::vector<Table1Row>& rows) {
  for (std::size_t i = 0; i < kRows; ++i) {
    rows.push_back(measured.front()[i]);
    for (std::size_t n = 1; n < measured.size(); ++n) rows.back().add(measured[n][i]);
  }
}

void measure_matched(const Table1Options& options, Parallel& parallel, std::vector<Table1Row>& rows) {
  const SensorSpec model = bench_sensor(SensorKind::kBumblebee, false);
  const RoiSettings roi = perception_for(SensorKind::kBumblebee, {}).roi;
  std::vector<std::optional<MatchedPairs>> eyes(static_cast<std::size_t>(parallel.workers()));
  std::vector<Rows> measured(static_cast<std::size_t>(options.configurations));
  parallel.run(options.configurations, [&](int number, int worker) {
    const auto n = static_cast<std::size_t>(number);
    auto& pairs = eyes[static_cast<std::size_t>(worker)];
    if (!pairs) pairs.emplace(model, roi, options.seed);
    const ObstacleCourse course =
        random_course(model, covered_area(SensorKind::kBumblebee), random_key({options.seed, n}));
    measured[n] =
        measure(SensorKind::kBumblebee, course, pairs->see(course.shapes, course.T_world_body, number));
    for (Table1Row& row : measured[n]) row.matched = true;
  });
  append(measured, rows);
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

void HeightErrors::add(const HeightErrors& more) {
  count += more.count;
  missed += more.missed;
  sum_m += more.sum_m;
  worst_m = std::max(worst_m, more.worst_m);
}

void TopErrors::add(const TopErrors& more) {
  flat.add(more.flat);
  sloped.add(more.sloped);
}

HeightErrors TopErrors::all() const {
  HeightErrors errors = flat;
  errors.add(sloped);
  return errors;
}

void Table1Row::add(const Table1Row& more) {
  near.add(more.near);
  far.add(more.far);
  floor_square_m2 += more.floor_square_m2;
  floor_vertices += more.floor_vertices;
}

CoveredArea covered_area(SensorKind sensor) {
  return sensor == SensorKind::kKinect ? CoveredArea{5.5, 3.0} : CoveredArea{6.0, 4.2};
}

PerceptionSettings perception_for(SensorKind sensor, const SectionSettings& sections) {
  const CoveredArea area = covered_area(sensor);
  PerceptionSettings settings;
  settings.roi.x_max_m = area.length_m;
  settings.roi.y_min_m = -0.5 * area.width_m;
  settings.roi.y_max_m = 0.5 * area.width_m;
  settings.sections = sections;
  return settings;
}

SensorSpec bench_sensor(SensorKind sensor, bool correlated) {
  SensorSpec model = sensor == SensorKind::kKinect ? kinect() : bumblebee();
  if (correlated) model.noise.correlation_px = kBlockMatchingWindow_px;
  return model;
}

void judge(const ObstacleCourse& course, const GridMap& map, Table1Row& row) {
  // a vertex stands for a cell around its centre: the cells that touch the footprint, and one around
  const double reach_m = 1.5 * map.lattice().pitch_m;
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
    TopErrors& errors = obstacle.distance_m < kNear_m ? row.near : row.far;
    (obstacle.sloped ? errors.sloped : errors.flat).add(highest[i], obstacle.height_m);
  }
}

PaperRow paper_row(SensorKind sensor, int x_res, int y_res) {
  const auto sections = section_rows();
  const auto& rows = kPaper[sensor == SensorKind::kKinect ? 0 : 1];
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (sections[i].x_res == x_res && sections[i].y_res == y_res) return rows[i];
  return {};
}

std::vector<Table1Row> measure_table1(const Table1Options& options, Parallel& parallel,
                                      const std::function<void(const std::string&)>& progress) {
  std::vector<Table1Row> rows;
  for (const SensorKind sensor : options.sensors) {
    for (const bool correlated : {false, true}) {
      progress(fmt::format("Table 1: {}, {} noise, {} configurations", name_of(sensor),
                           noise_name(correlated), options.configurations));
      std::vector<Rows> measured(static_cast<std::size_t>(options.configurations));
      parallel.run(options.configurations, [&](int number, int) {
        const auto n = static_cast<std::size_t>(number);
        measured[n] = measure_simulated(sensor, correlated, random_key({options.seed, n}));
      });
      append(measured, rows);
    }
    if (!options.matched || sensor != SensorKind::kBumblebee) continue;
    progress(fmt::format("Table 1: matched pairs of images, {} configurations", options.configurations));
    measure_matched(options, parallel, rows);
  }
  return rows;
}

}  // namespace floornav
