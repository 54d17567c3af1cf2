#include "planner/taut_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "planner/clear_way.hpp"
#include "planner/route.hpp"

namespace floornav {
namespace {

constexpr std::array<std::int32_t, 4> kMoves{8, 4, 2, 1};  ///< cells that a corner is moved by, in turn
constexpr int kRounds = 4;                                 ///< over all corners, with each of them
constexpr double kLeastGain = 1e-6;                        ///< of a way's cost
constexpr double kLongLine = 6.0;                          ///< cells; such a corner may become two

/// A way whose corners are being moved.
class String {
 public:
  String(const PlanningGrid& grid, std::vector<GridPoint> corners, double heading_rad, double turn_cost)
      : grid_(grid), corners_(std::move(corners)), heading_rad_(heading_rad), turn_cost_(turn_cost) {
    for (std::size_t i = 1; i < corners_.size(); ++i)
      known_.push_back(is_known(corners_[i - 1], corners_[i]));
  }

  void pull() {
    for (const std::int32_t by : kMoves)
      for (int round = 0; round < kRounds; ++round)
        if (!improve_all(by)) break;
  }
  [[nodiscard]] std::vector<GridPoint> take() { return std::move(corners_); }

 private:
  bool improve_all(std::int32_t by) {
    bool better = false;
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
      if (known_[i - 1] != known_[i]) continue;
      cost_ = cost_of({corners_[i - 1], corners_[i], corners_[i + 1]}, i);
      better = leave_out(i) || split(i, by) || move(i, by) || better;
      if (i + 1 >= corners_.size()) break;
    }
    return better;
  }

  bool leave_out(std::size_t i) { return replace(i, {}); }

  bool move(std::size_t i, std::int32_t by) {
    const GridPoint here = corners_[i];
    for (std::size_t k = 0; k < 8; ++k)
      if (replace(i, {{here.x + by * kStepX[k], here.y + by * kStepY[k]}})) return true;
    return false;
  }

  /// Cuts a corner off.
  bool split(std::size_t i, std::int32_t by) {
    const auto towards = [&](GridPoint other) {
      const GridPoint here = corners_[i];
      const double t = std::min(0.5, by / std::hypot(other.x - here.x, other.y - here.y));
      return GridPoint{std::round(here.x + t * (other.x - here.x)),
                       std::round(here.y + t * (other.y - here.y))};
    };
    const GridPoint before = corners_[i - 1], here = corners_[i], after = corners_[i + 1];
    if (std::hypot(before.x - here.x, before.y - here.y) < kLongLine ||
        std::hypot(after.x - here.x, after.y - here.y) < kLongLine)
      return false;
    return replace(i, {towards(before), towards(after)});
  }

  /// Puts others in the place of a corner, if that is cheaper and as free.
  bool replace(std::size_t i, const std::vector<GridPoint>& others) {
    std::vector<GridPoint> after{corners_[i - 1]};
    after.insert(after.end(), others.begin(), others.end());
    after.push_back(corners_[i + 1]);
    const double enough = cost_ * (1 - kLeastGain);
    if (length_of(after) >= enough || cost_of(after, i) >= enough || !is_open(after, i)) return false;
    const auto at = static_cast<std::ptrdiff_t>(i);
    const char known = known_[i];
    corners_.erase(corners_.begin() + at);
    corners_.insert(corners_.begin() + at, others.begin(), others.end());
    known_.erase(known_.begin() + at);
    known_.insert(known_.begin() + at, others.size(), known);
    return true;
  }

  /// Where the robot heads before corner i - 1, and behind corner i + 1; `way` leads from the one to the
  /// other.
  [[nodiscard]] double heading_before(std::size_t i) const {
    return i == 1 ? heading_rad_ : heading_between(corners_[i - 2], corners_[i - 1]);
  }
  [[nodiscard]] double heading_behind(std::size_t i, const std::vector<GridPoint>& way) const {
    return i + 2 < corners_.size() ? heading_between(corners_[i + 1], corners_[i + 2])
                                   : heading_between(way[way.size() - 2], way.back());
  }

  /// Less than the cost.
  [[nodiscard]] static double length_of(const std::vector<GridPoint>& way) {
    double length = 0;
    for (std::size_t k = 1; k < way.size(); ++k)
      length += std::hypot(way[k].x - way[k - 1].x, way[k].y - way[k - 1].y);
    return length;
  }

  [[nodiscard]] double cost_of(const std::vector<GridPoint>& way, std::size_t i) const {
    double cost = 0, heading_rad = heading_before(i);
    const auto turn_to = [&](double next_rad) {
      cost += turn_cost_ * std::abs(std::remainder(next_rad - heading_rad, 2 * std::numbers::pi));
      heading_rad = next_rad;
    };
    for (std::size_t k = 1; k < way.size(); ++k) {
      if (!grid_.search_grid().contains(cell_at(way[k]))) return std::numeric_limits<double>::infinity();
      turn_to(heading_between(way[k - 1], way[k]));
      cost += line_cost(grid_.search_grid(), way[k - 1], way[k]);
    }
    turn_to(heading_behind(i, way));
    return cost;
  }

  [[nodiscard]] bool is_open(const std::vector<GridPoint>& way, std::size_t i) const {
    const auto turns = [&](GridPoint at, double from_rad, double to_rad) {
      return turn_clear(grid_, at, from_rad, to_rad, Avoid::kBlocked);
    };
    double heading_rad = heading_before(i);
    for (std::size_t k = 1; k < way.size(); ++k) {
      const GridPoint a = way[k - 1], b = way[k];
      if (a == b || !line_clear(grid_, a, b) || (known_[i] != 0 && !is_known(a, b))) return false;
      if (!turns(a, heading_rad, heading_between(a, b))) return false;
      heading_rad = heading_between(a, b);
    }
    return turns(way.back(), heading_rad, heading_behind(i, way));
  }

  [[nodiscard]] bool is_known(GridPoint a, GridPoint b) const { return known_free_part(grid_, a, b) == 1.0; }

  const PlanningGrid& grid_;
  std::vector<GridPoint> corners_;
  std::vector<char> known_;  ///< of each line: it keeps to known free floor
  double heading_rad_;
  double turn_cost_;
  double cost_ = 0;  ///< of the lines and turns at the corner that is being moved
};

}  // namespace

std::vector<GridPoint> pulled_taut(const PlanningGrid& grid, std::vector<GridPoint> corners,
                                   double heading_rad, double turn_cost) {
  if (corners.size() < 3) return corners;
  String string(grid, std::move(corners), heading_rad, turn_cost);
  string.pull();
  return string.take();
}

}  // namespace floornav
