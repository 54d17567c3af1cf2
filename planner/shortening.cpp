#include "planner/shortening.hpp"

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

}  // namespace

std::vector<GridPoint> shorten(const PlanningGrid& grid, const std::vector<GridCell>& path,
                               double heading_rad) {
  const Joiner joiner(grid, path);
  std::vector<std::size_t> corners{0};  // places in the path
  const auto before = [&](std::size_t i) {
    return i == 0 ? heading_rad : joiner.heading(corners[i - 1], corners[i]);
  };
  const auto on = [&](std::size_t from, std::size_t to, std::size_t next) {
    return next < path.size() ? joiner.heading(to, next) : joiner.heading(from, to);
  };
  for (std::size_t to = 2; to < path.size(); ++to) {
    const std::size_t from = corners.back();
    if (!joiner.may_join(from, to, before(corners.size() - 1), on(from, to, to + 1)))
      corners.push_back(to - 1);
  }
  if (path.size() > 1) corners.push_back(path.size() - 1);
  // A line that failed on its way may yet reach further: leave out single corners as long as that is
  // possible.
  for (std::size_t i = 1; i + 1 < corners.size();) {
    const std::size_t next = i + 2 < corners.size() ? corners[i + 2] : path.size();
    if (joiner.may_join(corners[i - 1], corners[i + 1], before(i - 1),
                        on(corners[i - 1], corners[i + 1], next))) {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      i = std::max<std::size_t>(i - 1, 1);
    } else {
      ++i;
    }
  }
  std::vector<GridPoint> points;
  for (const std::size_t place : corners) points.push_back(centre(path[place]));
  return points;
}

}  // namespace floornav
