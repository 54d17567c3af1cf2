#include "tools/simulator/true_route.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace floornav {
namespace {

/// The truth's cells with what the robot's footprint cannot stand on.
class Room {
 public:
  Room(const TruthGrid& truth, double radius_m) : truth_(truth), open_(truth.cells.size()) {
    for (std::size_t i = 0; i < truth.cells.size(); ++i) open_[i] = truth.cells[i].drivable;
    const int reach = static_cast<int>(std::ceil(radius_m / truth.lattice.pitch_m));
    for (int y = 0; y < truth.height; ++y)
      for (int x = 0; x < truth.width; ++x)
        if (!truth.cells[index(x, y)].drivable) close_around(x, y, reach, radius_m / truth.lattice.pitch_m);
  }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y * truth_.width + x);
  }
  [[nodiscard]] bool open(int x, int y) const {
    return x >= 0 && y >= 0 && x < truth_.width && y < truth_.height && open_[index(x, y)];
  }

 private:
  void close_around(int x, int y, int reach, double radius) {
    for (int v = std::max(0, y - reach); v <= std::min(truth_.height - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(truth_.width - 1, x + reach); ++u)
        if ((u - x) * (u - x) + (v - y) * (v - y) <= radius * radius) open_[index(u, v)] = false;
  }

  const TruthGrid& truth_;
  std::vector<bool> open_;
};

/// The straight steps from a cell: to all cells up to 4 columns and rows away that have no nearer cell on the
/// way.
struct Step {
  int x;
  int y;
  double length;
};
std::vector<Step> steps() {
  std::vector<Step> all;
  for (int y = -4; y <= 4; ++y)
    for (int x = -4; x <= 4; ++x)
      if (std::gcd(x, y) == 1) all.push_back({x, y, std::hypot(x, y)});
  return all;
}

/// Whether every cell that the middle line of a step touches is open.
bool passes(const Room& room, int x, int y, const Step& step) {
  const int samples = 4 * std::max(std::abs(step.x), std::abs(step.y));
  for (int i = 1; i <= samples; ++i) {
    const double along = static_cast<double>(i) / samples;
    const double u = x + along * step.x;
    const double v = y + along * step.y;
    for (const double side : {-0.01, 0.01})
      if (!room.open(static_cast<int>(std::lround(u + side)), static_cast<int>(std::lround(v + side))) ||
          !room.open(static_cast<int>(std::lround(u + side)), static_cast<int>(std::lround(v - side))))
        return false;
  }
  return true;
}

}  // namespace

std::optional<double> shortest_way_m(const TruthGrid& truth, double radius_m, const Eigen::Vector2d& start,
                                     const Eigen::Vector2d& goal, double tolerance_m) {
  const Room room(truth, radius_m);
  const auto place = [&truth](const Eigen::Vector2d& p) {
    const CellIndex cell = truth.lattice.cell_of(p.x(), p.y());
    return std::pair<int, int>{cell.ix - truth.origin.ix, cell.iy - truth.origin.iy};
  };
  const std::pair<int, int> begin = place(start);
  const std::pair<int, int> end = place(goal);
  const double near_cells = tolerance_m / truth.lattice.pitch_m;
  if (!room.open(begin.first, begin.second)) return std::nullopt;
  std::vector<double> length(truth.cells.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::pair<int, int>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  length[room.index(begin.first, begin.second)] = 0;
  queue.push({0.0, begin});
  const std::vector<Step> all = steps();
  while (!queue.empty()) {
    const auto [so_far, cell] = queue.top();
    queue.pop();
    const auto [x, y] = cell;
    if (std::hypot(x - end.first, y - end.second) <= near_cells) return so_far * truth.lattice.pitch_m;
    if (so_far > length[room.index(x, y)]) continue;
    for (const Step& step : all) {
      if (!room.open(x + step.x, y + step.y)) continue;
      const double next = so_far + step.length;
      double& best = length[room.index(x + step.x, y + step.y)];
      if (next >= best || !passes(room, x, y, step)) continue;
      best = next;
      queue.push({next, {x + step.x, y + step.y}});
    }
  }
  return std::nullopt;
}

}  // namespace floornav
