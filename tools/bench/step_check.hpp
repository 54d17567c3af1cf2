#pragma once

#include "mapping/grid_map.hpp"
#include "tools/bench/step_course.hpp"

namespace floornav {

/// Whether the map shows the step: at half or more of the places along it an edge of the grid between 0.1 m
/// before and 0.1 m behind is closed, or the heights there differ by the rise within half of it. Where
/// nothing was seen the next known vertex counts, up to 0.2 m farther away; behind an edge that falls, from
/// the first floor on that can be seen.
bool shows_step(const GridMap& map, const StepEdge& edge);

/// Places on a plain floor, 0.2 m apart, and how many of them look like a step of 1 cm: a closed edge to a
/// place 0.2 m away, or a difference from the true heights of half a centimetre or more.
struct PlainCheck {
  static constexpr double kSpacing_m = 0.2;

  int places = 0;
  int alarms = 0;

  [[nodiscard]] double seen_m2() const { return places * kSpacing_m * kSpacing_m; }
};
PlainCheck check_plain(const GridMap& map, const Ground& ground);

}  // namespace floornav
