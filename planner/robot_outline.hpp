#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "planner/search/line_of_sight.hpp"
#include "runtime/geometry/robot.hpp"

namespace floornav {

/// Corners of a convex area, counter-clockwise, in columns and rows of a grid.
using ConvexArea = std::vector<GridPoint>;

/// Cells [x0, x1] of row y.
struct RowSpan {
  std::int32_t y = 0;
  std::int32_t x0 = 0;
  std::int32_t x1 = 0;
};

/// The cells whose squares an area overlaps; squares that it only touches do not count.
std::vector<RowSpan> cells_under(const ConvexArea& area);

/// The robot's outline on a grid: a circle, or a convex polygon around the point that it turns about. What it
/// sweeps on straight lines is exact; on turns in place it is exact but for a few millimetres, on the safe
/// side.
class RobotOutline {
 public:
  /// Lengths are turned to cells. Throws std::invalid_argument for an outline that is no area, does not hold
  /// the body's origin, or reaches out of the robot's circle.
  RobotOutline(const RobotSettings& robot, double pitch_m);

  [[nodiscard]] bool is_circle() const { return outline_.empty(); }
  /// Of circles around the body's origin: the largest within the outline and its margin, the smallest around
  /// them; cells.
  [[nodiscard]] double inner_radius() const { return inner_radius_; }
  [[nodiscard]] double outer_radius() const { return outer_radius_; }

  /// What a polygon sweeps from a to b; it heads from the one to the other, or for `heading_rad` where they
  /// are the same.
  [[nodiscard]] ConvexArea along(GridPoint a, GridPoint b, double heading_rad = 0) const;
  /// And turning in place, the short way round.
  [[nodiscard]] std::vector<ConvexArea> turning(GridPoint at, double from_rad, double to_rad) const;

  /// The cells that a polygon sweeps on the step from cell (0, 0) to neighbour k, and turning there from
  /// heading for neighbour k to the next one.
  [[nodiscard]] const std::vector<RowSpan>& step(std::size_t k) const { return steps_[k]; }
  [[nodiscard]] const std::vector<RowSpan>& turn(std::size_t k) const { return turns_[k]; }

 private:
  [[nodiscard]] ConvexArea at(GridPoint place, double heading_rad, double scale) const;

  ConvexArea outline_;  ///< in the body frame, with its margin; empty: a circle
  double inner_radius_ = 0, outer_radius_ = 0;
  std::array<std::vector<RowSpan>, 8> steps_, turns_;
};

}  // namespace floornav
