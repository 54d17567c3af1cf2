#include "tools/bench/steps.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/bench/frame_stack.hpp"
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
constexpr int kBlockMatchingWindow_px = 9;

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

SensorSpec sensor_of(SensorKind kind, bool correlated) {
  SensorSpec spec = kind == SensorKind::kKinect ? kinect() : bumblebee();
  if (correlated) spec.noise.correlation_px = kBlockMatchingWindow_px;
  return spec;
}

/// The last frames of a robot that drives slowly up to where the course has it.
std::unique_ptr<FrameStack> drive_up(const StepCourse& course, DepthSensor& sensor, int frames) {
  auto stack = std::make_unique<FrameStack>(PerceptionSettings{}, MappingSettings{}, RobotSettings{});
  for (int frame = 0; frame < frames; ++frame) {
    const Eigen::Vector2d ahead = course.T_world_body.linear().col(0).head<2>().normalized();
    const Eigen::Vector2d end = course.T_world_body.translation().head<2>();
    const PlanarState state{end - (frames - 1 - frame) * kMovePerFrame_m * ahead, ahead};
    const Pose T_world_body = body_on_floor(course.shapes, state);
    stack->see(sensor, sensor.measure(course.shapes, T_world_body, frame), T_world_body);
  }
  return stack;
}

double false_alarms_per_m2(const SensorSpec& spec, int frames, double plain_m2, std::uint64_t seed) {
  double seen_m2 = 0;
  double alarms = 0;
  for (std::uint64_t number = 0; seen_m2 < plain_m2; ++number) {
    const std::uint64_t key = random_key({seed, number});
    const StepCourse course = plain_course(key);
    DepthSensor sensor(spec, key);
    const PlainCheck check = check_plain(drive_up(course, sensor, frames)->published(), course.shapes.ground);
    if (check.places == 0) throw std::runtime_error("nothing was seen of a plain floor");
    seen_m2 += check.places * kPlainSpacing_m * kPlainSpacing_m;
    alarms += check.alarms;
  }
  return alarms / seen_m2;
}

void measure_height(const SensorSpec& spec, int frames, int poses, double height_m, std::uint64_t seed,
                    std::span<StepRow> rows) {
  for (int pose = 0; pose < poses; ++pose) {
    const std::uint64_t key = random_key({seed, static_cast<std::uint64_t>(pose), 0x57E9});
    const StepCourse course = step_course(height_m, key);
    DepthSensor sensor(spec, key);
    const auto stack = drive_up(course, sensor, frames);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ++rows[i].poses;
      rows[i].found += shows_step(stack->published(), course.edges[i]) ? 1 : 0;
    }
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
    const Eigen::Vector2d behind = place + kSide_m * edge.across;
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

std::vector<StepRow> measure_steps(int poses, double plain_m2, std::uint64_t seed,
                                   const std::function<void(const std::string&)>& progress) {
  std::vector<StepRow> rows;
  for (const SensorKind kind : {SensorKind::kKinect, SensorKind::kBumblebee}) {
    for (const bool correlated : {false, true}) {
      const SensorSpec spec = sensor_of(kind, correlated);
      for (const int frames : {1, kFrames}) {
        progress(fmt::format("steps: {}, {} noise, {} frames",
                             kind == SensorKind::kKinect ? "Kinect" : "Bumblebee",
                             correlated ? "correlated" : "independent", frames));
        const double alarms = false_alarms_per_m2(spec, frames, plain_m2, seed);
        for (const double height_m : kHeights_m) {
          const std::size_t first = rows.size();
          for (const double distance_m : kStepDistances_m)
            rows.push_back({kind, correlated, height_m, distance_m, frames, 0, 0, alarms});
          measure_height(spec, frames, poses, height_m, seed, std::span(rows).subspan(first));
        }
      }
    }
  }
  return rows;
}

}  // namespace floornav
