#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

TEST(Terrain, ShowsAllHeightsAtItsOwnResolution) {
  WorldMap map = mapped({see(with_block(ramp(5, 2.4, 3.2), {0.8, 1.6, -0.4, 0.4}, 0.5))});
  map.refresh_terrain();
  const TerrainMap& terrain = map.terrain();
  const auto height = [&](double x_m, double y_m) {
    return terrain.height_m(terrain.lattice().cell_of(x_m, y_m));
  };
  EXPECT_NEAR(height(0.5, 0), 0, 1e-3);
  EXPECT_NEAR(height(1.3, 0.1), 0.5, 1e-3);
  EXPECT_NEAR(height(2.9, 0.5), 0.5 * std::tan(5 * std::numbers::pi / 180), 1e-3);
  EXPECT_TRUE(std::isnan(height(5, 0)));
  EXPECT_TRUE(std::isnan(height(-0.1, 0)));
}

TEST(Terrain, FollowsChangesOnly) {
  WorldMap map = mapped({see(flat(), {-4, 4, -4, 4})});
  const auto first = map.refresh_terrain();
  EXPECT_EQ(first, map.terrain().sorted_tiles());
  EXPECT_TRUE(map.refresh_terrain().empty());
  map.integrate(see(flat(0.4), {1.0, 1.2, 1.0, 1.2}));
  map.refresh();
  EXPECT_EQ(map.refresh_terrain(), (std::vector<CellIndex>{{0, 0}}));
  EXPECT_NEAR(map.terrain().height_m(map.terrain().lattice().cell_of(1.1, 1.1)), 0.4, 1e-3);
}

}  // namespace
}  // namespace floornav
