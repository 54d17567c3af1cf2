#include "tools/simulator/drivable.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <string>

#include "tools/simulator/portable_math.hpp"
#include "tools/simulator/surface.hpp"

namespace floornav {
namespace {

constexpr double kSample_m = 0.01;
constexpr double kTouch_m = 1e-6;
constexpr double kMostCells = 4e6;

/// The tangent of a robot's steepest slope.
double steepest(const RobotSettings& robot) {
  const SinCos slope = sin_cos_deg(robot.max_slope_deg);
  return slope.sin / slope.cos;
}

/// Whether a wheel gets from one sample to its neighbour: the difference is no more than a step and the slope
/// between.
bool passes(const SurfacePoint& a, const SurfacePoint& b, double distance_m, const RobotSettings& robot) {
  const double by_slope = std::max(a.slope, b.slope) * distance_m;
  return std::abs(a.z_m - b.z_m) <= robot.max_step_m + by_slope + kTouch_m;
}

bool stands(const SurfacePoint& s, const RobotSettings& robot) {
  return s.slope <= steepest(robot) + kTouch_m && s.clearance_m >= robot.height_m;
}

/// Judges cells by a square of samples that reaches one sample over each border, so that a step on the border
/// counts.
class CellSampler {
 public:
  CellSampler(const Shapes& shapes, const RobotSettings& robot, const Lattice& lattice)
      : shapes_(shapes),
        robot_(robot),
        lattice_(lattice),
        inner_(std::max(2, static_cast<int>(std::ceil(lattice.pitch_m / kSample_m)))),
        side_(inner_ + 2),
        samples_(static_cast<std::size_t>(side_ * side_)) {}

  TruthCell judge(CellIndex cell) {
    const double distance = lattice_.pitch_m / inner_;
    double sum = 0;
    TruthCell truth{0.0F, -1e9F, true, false, true};
    for (int j = 0; j < side_; ++j) {
      for (int i = 0; i < side_; ++i) {
        const Eigen::Vector2d place(cell.ix * lattice_.pitch_m + (i - 0.5) * distance,
                                    cell.iy * lattice_.pitch_m + (j - 0.5) * distance);
        SurfacePoint& sample = at(i, j);
        sample = surface_at(shapes_, place);
        const bool drives = stands(sample, robot_);
        const bool from_left = i == 0 || passes(at(i - 1, j), sample, distance, robot_);
        const bool from_below = j == 0 || passes(at(i, j - 1), sample, distance, robot_);
        truth.standable = truth.standable && drives && from_left && from_below;
        if (i == 0 || j == 0 || i == side_ - 1 || j == side_ - 1) continue;
        truth.beside_step = truth.beside_step && drives && (i == 1 || from_left) && (j == 1 || from_below);
        sum += sample.z_m;
        const double ceiling = shapes_.ground.z_m(place) + robot_.height_m;
        truth.highest_m = std::max(truth.highest_m, static_cast<float>(top_at(shapes_, place, ceiling)));
      }
    }
    truth.height_m = static_cast<float>(sum / (inner_ * inner_));
    return truth;
  }

 private:
  SurfacePoint& at(int i, int j) { return samples_[static_cast<std::size_t>(j * side_ + i)]; }

  const Shapes& shapes_;
  const RobotSettings& robot_;
  Lattice lattice_;
  int inner_;
  int side_;
  std::vector<SurfacePoint> samples_;
};

/// Marks what is reached from the start from one standable cell to the next.
void flood(TruthGrid& grid, CellIndex start) {
  const auto cell = [&grid](CellIndex c) -> TruthCell* {
    const std::int32_t i = c.ix - grid.origin.ix;
    const std::int32_t j = c.iy - grid.origin.iy;
    if (i < 0 || j < 0 || i >= grid.width || j >= grid.height) return nullptr;
    return &grid.cells[static_cast<std::size_t>(j * grid.width + i)];
  };
  std::deque<CellIndex> open;
  const auto reach = [&](CellIndex c) {
    TruthCell* truth = cell(c);
    if (truth == nullptr || !truth->standable || truth->drivable) return;
    truth->drivable = true;
    open.push_back(c);
  };
  reach(start);
  while (!open.empty()) {
    const CellIndex c = open.front();
    open.pop_front();
    for (const CellIndex d : {CellIndex{1, 0}, CellIndex{-1, 0}, CellIndex{0, 1}, CellIndex{0, -1}})
      reach({c.ix + d.ix, c.iy + d.iy});
  }
}

/// Keeps `beside_step`, so far true where the inside alone could be driven on, where the cell could be
/// reached from a drivable one beside it.
void keep_reachable_besides(TruthGrid& grid, const RobotSettings& robot) {
  const double level_m = robot.max_step_m + steepest(robot) * grid.lattice.pitch_m;
  const auto leads_to = [&](const TruthCell* from, const TruthCell& to) {
    return from != nullptr && from->drivable && std::abs(from->height_m - to.height_m) <= level_m;
  };
  for (std::int32_t j = 0; j < grid.height; ++j) {
    for (std::int32_t i = 0; i < grid.width; ++i) {
      const auto place = static_cast<std::size_t>(j * grid.width + i);
      TruthCell& cell = grid.cells[place];
      const auto side = [&](std::int32_t di, std::int32_t dj) -> const TruthCell* {
        const bool inside = i + di >= 0 && j + dj >= 0 && i + di < grid.width && j + dj < grid.height;
        return inside ? &grid.cells[static_cast<std::size_t>((j + dj) * grid.width + i + di)] : nullptr;
      };
      cell.beside_step = cell.beside_step && !cell.standable &&
                         (leads_to(side(1, 0), cell) || leads_to(side(-1, 0), cell) ||
                          leads_to(side(0, 1), cell) || leads_to(side(0, -1), cell));
    }
  }
}

}  // namespace

const TruthCell* TruthGrid::at(const Eigen::Vector2d& place) const {
  const CellIndex cell = lattice.cell_of(place.x(), place.y());
  const std::int32_t i = cell.ix - origin.ix;
  const std::int32_t j = cell.iy - origin.iy;
  if (i < 0 || j < 0 || i >= width || j >= height) return nullptr;
  return &cells[static_cast<std::size_t>(j * width + i)];
}

TruthGrid truth_of(const Scene& scene, const RobotSettings& robot, double resolution_m,
                   const Eigen::Vector2d& start) {
  TruthGrid grid;
  grid.lattice.pitch_m = resolution_m;
  const double inside = 1e-6;
  grid.origin = grid.lattice.cell_of(scene.area_min_m.x() + inside, scene.area_min_m.y() + inside);
  const CellIndex last = grid.lattice.cell_of(scene.area_max_m.x() - inside, scene.area_max_m.y() - inside);
  grid.width = last.ix - grid.origin.ix + 1;
  grid.height = last.iy - grid.origin.iy + 1;
  const double cells = static_cast<double>(grid.width) * grid.height;
  if (cells > kMostCells)
    throw std::invalid_argument("the truth of this area would have " +
                                std::to_string(static_cast<long long>(cells)) +
                                " cells; a coarser resolution is needed");
  grid.cells.reserve(static_cast<std::size_t>(cells));
  CellSampler sampler(scene.fixed, robot, grid.lattice);
  for (std::int32_t iy = grid.origin.iy; iy <= last.iy; ++iy)
    for (std::int32_t ix = grid.origin.ix; ix <= last.ix; ++ix) grid.cells.push_back(sampler.judge({ix, iy}));
  flood(grid, grid.lattice.cell_of(start.x(), start.y()));
  keep_reachable_besides(grid, robot);
  return grid;
}

}  // namespace floornav
