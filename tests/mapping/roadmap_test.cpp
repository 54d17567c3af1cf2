#include "mapping/roadmap.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

namespace floornav {
namespace {

/// A map that is free where `is_free` says so, within 0 .. 8 m.
GridMap made(const std::function<bool(double x_m, double y_m)>& is_free) {
  GridMap map(0.05);
  for (std::int32_t iy = 0; iy < 160; ++iy) {
    for (std::int32_t ix = 0; ix < 160; ++ix) {
      const CellIndex cell{ix, iy};
      const bool free = is_free(map.lattice().center_of(ix), map.lattice().center_of(iy));
      map.make(GridMap::tile_of(cell)).state[static_cast<std::size_t>(GridTile::index_of(cell))] =
          free ? VertexState::kFree : VertexState::kBlocked;
    }
  }
  return map;
}

bool within(double x_m, double low_m, double high_m) {
  return x_m > low_m && x_m < high_m;
}

/// Nodes that ways join to a node.
std::size_t reached_from(const Roadmap& roadmap, std::int32_t node) {
  std::vector<bool> reached(roadmap.nodes.size());
  reached[static_cast<std::size_t>(node)] = true;
  for (std::size_t round = 0; round < roadmap.nodes.size(); ++round) {
    for (const Roadmap::Way& way : roadmap.ways) {
      const bool either =
          reached[static_cast<std::size_t>(way.from)] || reached[static_cast<std::size_t>(way.to)];
      reached[static_cast<std::size_t>(way.from)] = reached[static_cast<std::size_t>(way.to)] = either;
    }
  }
  return static_cast<std::size_t>(std::ranges::count(reached, true));
}

TEST(Roadmap, OfACorridorIsItsMiddle) {
  const Roadmap roadmap =
      make_roadmap(made([](double x, double y) { return within(x, 1, 7) && within(y, 2, 4); }), 0.5);
  ASSERT_FALSE(roadmap.ways.empty());
  double along_m = 0;
  for (const Roadmap::Way& way : roadmap.ways) {
    EXPECT_GE(way.clearance_m, 0.5);
    along_m += way.length_m;
    for (const Eigen::Vector2d& place : way.places_m) {
      if (within(place.x(), 2.2, 5.8)) {
        EXPECT_NEAR(place.y(), 3, 0.051);
      }
    }
  }
  EXPECT_GE(along_m, 3.6);
}

TEST(Roadmap, OfARoomWithAPillarGoesAroundIt) {
  const Roadmap roadmap = make_roadmap(made([](double x, double y) {
                                         const bool pillar = within(x, 3.4, 4.6) && within(y, 3.4, 4.6);
                                         return within(x, 1, 7) && within(y, 1, 7) && !pillar;
                                       }),
                                       0.4);
  for (const double side : {-1.0, 1.0}) {
    int beside = 0;
    for (const Roadmap::Way& way : roadmap.ways)
      for (const Eigen::Vector2d& place : way.places_m)
        beside += std::abs(place.x() - 4) < 0.03 && side * (place.y() - 4) > 0.6 ? 1 : 0;
    EXPECT_GE(beside, 1) << side;
  }
}

TEST(Roadmap, JoinsRoomsThroughADoorThatIsWideEnoughAndNotThroughANarrowOne) {
  const auto rooms = [](double door_m) {
    return made([door_m](double x, double y) {
      const bool wall = within(x, 3.9, 4.1) && std::abs(y - 4) > 0.5 * door_m;
      return within(x, 1, 7) && within(y, 1, 7) && !wall;
    });
  };
  const Roadmap wide = make_roadmap(rooms(1.2), 0.45);
  ASSERT_FALSE(wide.nodes.empty());
  EXPECT_EQ(reached_from(wide, 0), wide.nodes.size());
  const Roadmap narrow = make_roadmap(rooms(0.7), 0.45);
  ASSERT_FALSE(narrow.nodes.empty());
  EXPECT_LT(reached_from(narrow, 0), narrow.nodes.size());
}

TEST(Roadmap, OfNothingIsEmpty) {
  EXPECT_TRUE(make_roadmap(GridMap(0.05), 0.3).nodes.empty());
  EXPECT_TRUE(make_roadmap(made([](double, double) { return false; }), 0.3).ways.empty());
}

}  // namespace
}  // namespace floornav
