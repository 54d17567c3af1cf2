#include "tools/bench/steps.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/bench/frame_stack.hpp"
#include "tools/bench/sensor_names.hpp"
#include "tools/bench/table1.hpp"
#include "tools/simulator/random.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

constexpr std::array<double, 4> kHeights_m{0.01, 0.02, 0.03, 0.05};
constexpr int kFrames = 10;
constexpr double kMovePerFrame_m = 0.02;
constexpr double kSide_m = 0.1;    ///< of the places compared, before and behind an edge
constexpr double kAlong_m = 0.15;  ///< between places along an edge
constexpr double kPlainSpacing_m = 0.2;
constexpr double kFalseDifference_m = 0.005;
constexpr std::uint64_t kPlainAtOnce = 4;  ///< whatever the number of threads

std::optional<double> height_at(const GridMap& map, const Eigen::Vector2d& place) {
  const CellIndex cell = map.lattice().cell_of(place.x(), place.y());
  const GridTile* tile = map.find(GridMap::tile_of(cell));
  if (tile == nullptr) return std::nullopt;
  const std::int32_t index = GridTile::index_of(cell);
  if (tile->state[static_cast<std::size_t>(index)] == VertexState::kUnknown) return std::nullopt;
  return static_cast<double>(tile->height_m(index));
}

/// The number of the neighbour in direction (x, y), each -1, 0 or 1.
int neighbour_of(std::int32_t x, std::int32_t y) {
  for (int k = 0; k < 8; ++k)
    if (kNeighbourX[static_cast<std::size_t>(k)] == x && kNeighbourY[static_cast<std::size_t>(k)] == y)
      return k;
  return 0;
}

std::int32_t sign(std::int32_t x) {
  return (x > 0) - (x < 0);
}

/// Whether an edge is closed on the straight chain of known vertices between two places.
bool has_closed_edge(const GridMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  CellIndex cell = map.lattice().cell_of(from.x(), from.y());
  const CellIndex end = map.lattice().cell_of(to.x(), to.y());
  while (!(cell == end)) {
    const CellIndex next{cell.ix + sign(end.ix - cell.ix), cell.iy + sign(end.iy - cell.iy)};
    if (map.state(cell) == VertexState::kUnknown || map.state(next) == VertexState::kUnknown) return false;
    const GridTile& tile = *map.find(GridMap::tile_of(cell));
    const std::uint8_t edges = tile.edges[static_cast<std::size_t>(GridTile::index_of(cell))];
    if ((edges >> neighbour_of(next.ix - cell.ix, next.iy - cell.iy) & 1) == 0) return true;
    cell = next;
  }
  return false;
}

/// The last frames of a robot that drives slowly up to where the course has it.
std::unique_ptr<FrameStack> drive_up(const StepCourse& course, DepthSensor& sensor, int frames) {
  auto stack = std::make_unique<FrameStack>(perception_for(sensor.model().kind, SectionSettings{}),
                                            MappingSettings{}, RobotSettings{});
  for (int frame = 0; frame < frames; ++frame) {
    const Eigen::Vector2d ahead = course.T_world_body.linear().col(0).head<2>().normalized();
    const Eigen::Vector2d end = course.T_world_body.translation().head<2>();
    const PlanarState state{end - (frames - 1 - frame) * kMovePerFrame_m * ahead, ahead};
    const Pose T_world_body = body_on_floor(course.shapes, state);
    stack->see(sensor, sensor.measure(course.shapes, T_world_body, frame), T_world_body);
  }
  return stack;
}

struct Alarms {
  double seen_m2 = 0;
  int count = 0;
};

Alarms alarms_of_frame(const SensorSpec& spec, int frames, std::uint64_t key) {
  const StepCourse course = plain_course(key);
  DepthSensor sensor(spec, key);
  const PlainCheck check = check_plain(drive_up(course, sensor, frames)->published(), course.shapes.ground);
  if (check.places == 0) throw std::runtime_error("nothing was seen of a plain floor");
  return {check.places * kPlainSpacing_m * kPlainSpacing_m, check.alarms};
}

double false_alarms_per_m2(const SensorSpec& spec, int frames, const StepOptions& options,
                           Parallel& parallel) {
  Alarms all;
  for (std::uint64_t first = 0; all.seen_m2 < options.plain_m2; first += kPlainAtOnce) {
    std::array<Alarms, kPlainAtOnce> some;
    parallel.run(static_cast<int>(kPlainAtOnce), [&](int index, int) {
      const auto i = static_cast<std::size_t>(index);
      some[i] = alarms_of_frame(spec, frames, random_key({options.seed, first + i}));
    });
    for (const Alarms& alarms : some) {
      all.seen_m2 += alarms.seen_m2;
      all.count += alarms.count;
    }
  }
  return all.count / all.seen_m2;
}

/// Which of a course's edges the map shows.
std::array<bool, kStepDistances_m.size()> found_at(const SensorSpec& spec, int frames, double height_m,
                                                   std::uint64_t key) {
  const StepCourse course = step_course(height_m, key);
  DepthSensor sensor(spec, key);
  const auto stack = drive_up(course, sensor, frames);
  std::array<bool, kStepDistances_m.size()> found{};
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = shows_step(stack->published(), course.edges[i]);
  return found;
}

void measure_height(const SensorSpec& spec, const StepOptions& options, Parallel& parallel,
                    std::span<StepRow> rows) {
  std::vector<std::array<bool, kStepDistances_m.size()>> found(static_cast<std::size_t>(options.poses));
  parallel.run(options.poses, [&](int pose, int) {
    const auto p = static_cast<std::size_t>(pose);
    found[p] = found_at(spec, rows[0].frames, rows[0].height_m, random_key({options.seed, p, 0x57E9}));
  });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].poses = options.poses;
    for (const auto& of_pose : found) rows[i].found += of_pose[i] ? 1 : 0;
  }
}

}  // namespace

bool shows_step(const GridMap& map, const StepEdge& edge) {
  const Eigen::Vector2d along(-edge.across.y(), edge.across.x());
  int places = 0;
  int shown = 0;
  for (int k = -2; k <= 2; ++k) {
    const Eigen::Vector2d place = edge.middle_m + k * kAlong_m * along;
    const Eigen::Vector2d before = place - kSide_m * edge.across;
    const Eigen::Vector2d behind = place + (kSide_m + edge.hidden_m) * edge.across;
    const auto low = height_at(map, before);
    const auto high = height_at(map, behind);
    ++places;
    if (!low || !high) continue;
    const bool right_height = std::fabs(*high - *low - edge.rise_m) <= 0.5 * std::fabs(edge.rise_m);
    if (right_height || has_closed_edge(map, before, behind)) ++shown;
  }
  return 2 * shown >= places;
}

PlainCheck check_plain(const GridMap& map, const Ground& ground) {
  PlainCheck check;
  const auto spacing = static_cast<std::int32_t>(std::lround(kPlainSpacing_m / map.lattice().pitch_m));
  for (const CellIndex tile : map.sorted_tiles()) {
    for (std::int32_t j = 0; j < GridTile::kSide; j += spacing) {
      for (std::int32_t i = 0; i < GridTile::kSide; i += spacing) {
        const Eigen::Vector2d here(map.lattice().center_of(tile.ix * GridTile::kSide + i),
                                   map.lattice().center_of(tile.iy * GridTile::kSide + j));
        const auto z = height_at(map, here);
        if (!z) continue;
        ++check.places;
        bool alarm = false;
        for (const Eigen::Vector2d& step :
             {Eigen::Vector2d(kPlainSpacing_m, 0), Eigen::Vector2d(0, kPlainSpacing_m)}) {
          const auto other = height_at(map, here + step);
          if (!other) continue;
          const double wrong_m = *other - *z - ground.slope.dot(step);
          alarm =
              alarm || std::fabs(wrong_m) >= kFalseDifference_m || has_closed_edge(map, here, here + step);
        }
        check.alarms += alarm ? 1 : 0;
      }
    }
  }
  return check;
}

std::vector<StepRow> measure_steps(const StepOptions& options, Parallel& parallel,
                                   const std::function<void(const std::string&)>& progress) {
  std::vector<StepRow> rows;
  for (const SensorKind kind : options.sensors) {
    for (const bool correlated : {false, true}) {
      const SensorSpec spec = bench_sensor(kind, correlated);
      for (const int frames : {1, kFrames}) {
        progress(fmt::format("steps: {}, {} noise, {} frames a pose, {} poses", name_of(kind),
                             noise_name(correlated), frames, options.poses));
        const double alarms = false_alarms_per_m2(spec, frames, options, parallel);
        for (const double height_m : kHeights_m) {
          const std::size_t first = rows.size();
          for (const double distance_m : kStepDistances_m)
            rows.push_back({kind, correlated, height_m, distance_m, frames, 0, 0, alarms});
          measure_height(spec, options, parallel, std::span(rows).subspan(first));
        }
      }
    }
  }
  return rows;
}

}  // namespace floornav
