#include "planner/shortening.hpp"

#include <algorithm>

#include "planner/clear_way.hpp"
#include "planner/route.hpp"

namespace floornav {
namespace {

/// Which stretches of a path may be replaced by a straight line.
class Joiner {
 public:
  Joiner(const PlanningGrid& grid, const std::vector<GridCell>& path)
      : grid_(grid), path_(path), cost_(path.size(), 0.0), known_(path.size() + 1, 0) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      known_[i + 1] = known_[i] + (grid.known_free(path[i]) ? 1 : 0);
      if (i > 0)
        cost_[i] = cost_[i - 1] + line_cost(grid.search_grid(), centre(path[i - 1]), centre(path[i]));
    }
  }

  /// `before` and `after`: where the robot heads before and behind the line.
  [[nodiscard]] bool may_join(std::size_t from, std::size_t to, double before, double after) const {
    constexpr double kRounding = 1.0 + 1e-3;
    const GridPoint a = centre(path_[from]), b = centre(path_[to]);
    const std::size_t known = known_[to + 1] - known_[from];
    if (known != 0 && known != to - from + 1) return false;
    return line_clear(grid_, a, b) &&
           line_cost(grid_.search_grid(), a, b) <= (cost_[to] - cost_[from]) * kRounding &&
           (known == 0 || known_free_part(grid_, a, b) == 1.0) &&
           turn_clear(grid_, a, before, heading_between(a, b), Avoid::kBlocked) &&
           turn_clear(grid_, b, heading_between(a, b), after, Avoid::kBlocked);
  }
  [[nodiscard]] double heading(std::size_t from, std::size_t to) const {
    return heading_between(centre(path_[from]), centre(path_[to]));
  }

 private:
  const PlanningGrid& grid_;
  const std::vector<GridCell>& path_;
  std::vector<double> cost_;        ///< from the path's start, step by step
  std::vector<std::size_t> known_;  ///< cells of known free floor before each
};

/// A place before `end` that suits, as `first` does, and the next one does not: looked for in doubling
/// strides, then in halves.
template <class Suits>
std::size_t farthest(std::size_t first, std::size_t end, const Suits& suits) {
  std::size_t suitable = first, next = first + 1;
  for (std::size_t stride = 1; next < end && suits(next); stride *= 2) {
    suitable = next;
    next += stride;
  }
  std::size_t beyond = std::min(next, end);
  while (beyond - suitable > 1) {
    const std::size_t middle = suitable + (beyond - suitable) / 2;
    (suits(middle) ? suitable : beyond) = middle;
  }
  return suitable;
}

}  // namespace

std::vector<GridPoint> shorten(const PlanningGrid& grid, const std::vector<GridCell>& path,
                               double heading_rad) {
  const Joiner joiner(grid, path);
  std::vector<std::size_t> corners{0};  // places in the path
  while (corners.back() + 1 < path.size()) {
    const std::size_t from = corners.back();
    const double before =
        corners.size() > 1 ? joiner.heading(corners[corners.size() - 2], from) : heading_rad;
    const auto joins = [&](std::size_t to) {
      const double after = to + 1 < path.size() ? joiner.heading(to, to + 1) : joiner.heading(from, to);
      return joiner.may_join(from, to, before, after);
    };
    corners.push_back(farthest(from + 1, path.size(), joins));
  }
  std::vector<GridPoint> points;
  for (const std::size_t place : corners) points.push_back(centre(path[place]));
  return points;
}

}  // namespace floornav
