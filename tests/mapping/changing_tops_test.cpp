#include <algorithm>

#include <gtest/gtest.h>

#include "mapping/world_map.hpp"
#include "tests/mapping/made_evidence.hpp"

namespace floornav {
namespace {

constexpr Area kRoom{0, 5, -1, 1};

/// A flat top over a floor: a table that the floor is seen below, or a crate that hides it.
struct Top {
  Area area;
  double z_m;
  bool crate;
};

/// Whether the straight line from a sensor over the origin to a place is free of the top.
bool in_sight(double sensor_m, double x_m, double y_m, double z_m, const Top& top) {
  if (z_m >= top.z_m) return true;
  const double at_top =
      (sensor_m - top.z_m) / (sensor_m - z_m);  // share of the line down to the top's height
  if (!top.crate) return at_top < 0 || !inside(at_top * x_m, at_top * y_m, top.area);
  for (double t = std::max(at_top, 0.0); t <= 1; t += 0.01)
    if (inside(t * x_m, t * y_m, top.area)) return false;
  return true;
}

/// What a sensor above the origin sees of floor and top, by sight lines to the cells' centres.
FloorEvidence look(double sensor_m, const Top* top, std::int64_t utime_us) {
  const auto seen_floor = [&](double x_m, double y_m) -> std::optional<Ground> {
    if (top == nullptr) return Ground{0};
    if (top->crate && inside(x_m, y_m, top->area)) return std::nullopt;
    return in_sight(sensor_m, x_m, y_m, 0, *top) ? std::optional(Ground{0}) : std::nullopt;
  };
  FloorEvidence frame = see(seen_floor, kRoom);
  frame.utime_us = utime_us;
  frame.T_body_sensor.translation().z() = sensor_m;
  if (top == nullptr || sensor_m <= top->z_m) return frame;
  const FloorEvidence above = see(flat(top->z_m), top->area);
  for (CellEvidence cell : above.cells) {
    cell.surfel = static_cast<std::int16_t>(static_cast<std::size_t>(cell.surfel) + frame.surfels.size());
    frame.cells.push_back(cell);
  }
  frame.surfels.insert(frame.surfels.end(), above.surfels.begin(), above.surfels.end());
  return frame;
}

struct Blocked {
  int cells = 0;
  int blocked = 0;
};

Blocked blocked_in(const WorldMap& map, const Area& area) {
  Blocked count;
  const Lattice& lattice = map.grid().lattice();
  for (double y_m = area.y_min_m + 0.025; y_m < area.y_max_m; y_m += 0.05) {
    for (double x_m = area.x_min_m + 0.025; x_m < area.x_max_m; x_m += 0.05) {
      ++count.cells;
      count.blocked += map.grid().state(lattice.cell_of(x_m, y_m)) == VertexState::kBlocked ? 1 : 0;
    }
  }
  return count;
}

class ChangingTops : public testing::TestWithParam<double> {
 protected:
  void show(double sensor_m, const Top* top, int frames) {
    for (int i = 0; i < frames; ++i) {
      map_.integrate(look(sensor_m, top, ++frame_ * 33'000));
      map_.refresh();
    }
  }
  static RobotSettings tall_robot() {
    RobotSettings robot;
    robot.height_m = 1.0;
    return robot;
  }
  WorldMap map_{MappingSettings{}, tall_robot()};
  std::int64_t frame_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Heights, ChangingTops, testing::Values(0.42, 0.45, 0.5));

TEST_P(ChangingTops, ATableStaysBlockedHoweverLongTheFloorBelowItIsSeen) {
  const Top table{{0.8, 1.4, -0.3, 0.3}, GetParam(), false};
  show(0.72, &table, 40);
  const Blocked count = blocked_in(map_, table.area);
  EXPECT_EQ(count.cells, 144);
  EXPECT_EQ(count.blocked, count.cells);
}

TEST_P(ChangingTops, ATableStaysBlockedWhenOnlyTheFloorBelowItIsInViewLater) {
  const Top table{{0.8, 1.4, -0.3, 0.3}, 0.7, false};
  show(0.9, &table, 10);
  show(GetParam(), &table, 40);  // from below the top
  EXPECT_EQ(blocked_in(map_, table.area).blocked, 144);
}

TEST_P(ChangingTops, ACrateThatWasTakenAwayIsClearedWithinHalfASecond) {
  const Top crate{{0.8, 1.4, -0.3, 0.3}, GetParam(), true};
  show(0.72, &crate, 30);
  EXPECT_EQ(blocked_in(map_, crate.area).blocked, 144);
  show(0.72, nullptr, 15);
  EXPECT_EQ(blocked_in(map_, crate.area).blocked, 0);
}

}  // namespace
}  // namespace floornav
