#include "planner/robot_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "planner/search/search_grid.hpp"

namespace floornav {
namespace {

constexpr double kStepOfTurn_rad = std::numbers::pi / 18;
constexpr double kTouch = 1e-6;  ///< cells; what overlaps by less only touches

double cross(GridPoint o, GridPoint a, GridPoint b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Andrew's monotone chain; corners that lie on a side are left out.
ConvexArea convex_hull(std::vector<GridPoint> points) {
  std::sort(points.begin(), points.end(),
            [](GridPoint a, GridPoint b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  ConvexArea hull;
  const auto add_all = [&](auto begin, auto end, std::size_t keep) {
    for (auto it = begin; it != end; ++it) {
      while (hull.size() > keep && cross(hull[hull.size() - 2], hull.back(), *it) <= 0) hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  add_all(points.begin(), points.end(), 1);
  add_all(points.rbegin(), points.rend(), hull.size() + 1);
  return hull;
}

/// Every side moved outwards.
ConvexArea grown(const ConvexArea& area, double by) {
  ConvexArea result;
  for (std::size_t i = 0; i < area.size(); ++i) {
    const GridPoint before = area[(i + area.size() - 1) % area.size()], here = area[i],
                    after = area[(i + 1) % area.size()];
    const auto outwards = [](GridPoint a, GridPoint b) {
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      return GridPoint{(b.y - a.y) / length, -(b.x - a.x) / length};
    };
    const GridPoint m = outwards(before, here), n = outwards(here, after);
    const double share = by / (1 + m.x * n.x + m.y * n.y);
    result.push_back({here.x + share * (m.x + n.x), here.y + share * (m.y + n.y)});
  }
  return result;
}

/// The smallest spans that hold those of all areas, row by row.
std::vector<RowSpan> cells_under_all(const std::vector<ConvexArea>& areas) {
  std::vector<RowSpan> all;
  for (const ConvexArea& area : areas) {
    for (const RowSpan& span : cells_under(area)) {
      const auto same_row =
          std::find_if(all.begin(), all.end(), [&](const RowSpan& s) { return s.y == span.y; });
      if (same_row == all.end())
        all.push_back(span);
      else
        *same_row = {span.y, std::min(same_row->x0, span.x0), std::max(same_row->x1, span.x1)};
    }
  }
  return all;
}

}  // namespace

std::vector<RowSpan> cells_under(const ConvexArea& area) {
  const auto [lowest, highest] =
      std::minmax_element(area.begin(), area.end(), [](GridPoint a, GridPoint b) { return a.y < b.y; });
  const auto first = static_cast<std::int32_t>(std::floor(lowest->y - 0.5 + kTouch)) + 1;
  const auto last = static_cast<std::int32_t>(std::ceil(highest->y + 0.5 - kTouch)) - 1;
  std::vector<RowSpan> spans;
  for (std::int32_t y = first; y <= last; ++y) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < area.size(); ++i) {
      const GridPoint a = area[i], b = area[(i + 1) % area.size()];
      const double low = std::max(std::min(a.y, b.y), y - 0.5), high = std::min(std::max(a.y, b.y), y + 0.5);
      if (low > high) continue;
      for (const double at : {low, high}) {
        const double x = a.y == b.y ? a.x : a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y);
        least = std::min({least, x, a.y == b.y ? b.x : x});
        most = std::max({most, x, a.y == b.y ? b.x : x});
      }
    }
    const auto x0 = static_cast<std::int32_t>(std::floor(least - 0.5 + kTouch)) + 1;
    const auto x1 = static_cast<std::int32_t>(std::ceil(most + 0.5 - kTouch)) - 1;
    if (x0 <= x1) spans.push_back({y, x0, x1});
  }
  return spans;
}

RobotOutline::RobotOutline(const RobotSettings& robot, double pitch_m)
    : inner_radius_(robot.radius_m / pitch_m), outer_radius_(inner_radius_) {
  if (robot.footprint.empty()) return;
  for (const FootprintCorner& corner : robot.footprint) {
    if (std::hypot(corner.x_m, corner.y_m) > robot.radius_m + 1e-9)
      throw std::invalid_argument("robot.footprint reaches out of the circle of robot.radius_m");
    outline_.push_back({corner.x_m / pitch_m, corner.y_m / pitch_m});
  }
  outline_ = convex_hull(std::move(outline_));
  if (outline_.size() < 3) throw std::invalid_argument("robot.footprint has no area");
  outline_ = grown(outline_, robot.footprint_margin_m / pitch_m);
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const GridPoint a = outline_[i], b = outline_[(i + 1) % outline_.size()];
    const double to_side = cross({0, 0}, a, b) / std::hypot(b.x - a.x, b.y - a.y);
    if (to_side <= robot.footprint_margin_m / pitch_m)
      throw std::invalid_argument("robot.footprint must hold the body's origin, about which the robot turns");
    inner_radius_ = std::min(inner_radius_, to_side);
    outer_radius_ = std::max(outer_radius_, std::hypot(a.x, a.y));
  }
  for (std::size_t k = 0; k < 8; ++k) {
    const double heading_rad = static_cast<double>(k) * std::numbers::pi / 4;
    steps_[k] = cells_under(along({0, 0}, {static_cast<double>(kStepX[k]), static_cast<double>(kStepY[k])}));
    turns_[k] = cells_under_all(turning({0, 0}, heading_rad, heading_rad + std::numbers::pi / 4));
  }
}

ConvexArea RobotOutline::at(GridPoint place, double heading_rad, double scale) const {
  const double c = scale * std::cos(heading_rad), s = scale * std::sin(heading_rad);
  ConvexArea area;
  for (const GridPoint& p : outline_)
    area.push_back({place.x + c * p.x - s * p.y, place.y + s * p.x + c * p.y});
  return area;
}

ConvexArea RobotOutline::along(GridPoint a, GridPoint b, double heading_rad) const {
  if (a == b) return at(a, heading_rad, 1.0);
  heading_rad = std::atan2(b.y - a.y, b.x - a.x);
  ConvexArea both = at(a, heading_rad, 1.0);
  const ConvexArea end = at(b, heading_rad, 1.0);
  both.insert(both.end(), end.begin(), end.end());
  return convex_hull(std::move(both));
}

/// Between two headings a corner moves on an arc, which lies within the chord of a circle that much larger.
std::vector<ConvexArea> RobotOutline::turning(GridPoint place, double from_rad, double to_rad) const {
  const double turn_rad = std::remainder(to_rad - from_rad, 2 * std::numbers::pi);
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / kStepOfTurn_rad - 1e-9)));
  const double larger = 1.0 / std::cos(0.5 * turn_rad / pieces);
  std::vector<ConvexArea> areas;
  for (int i = 0; i < pieces; ++i) {
    ConvexArea both = at(place, from_rad + turn_rad * i / pieces, larger);
    const ConvexArea end = at(place, from_rad + turn_rad * (i + 1) / pieces, larger);
    both.insert(both.end(), end.begin(), end.end());
    areas.push_back(convex_hull(std::move(both)));
  }
  return areas;
}

}  // namespace floornav
