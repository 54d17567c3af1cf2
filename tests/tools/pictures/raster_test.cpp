#include "tools/pictures/raster.hpp"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace floornav {
namespace {

TEST(Raster, HoldsEverySeenVertexAtItsPlaceAndNothingElse) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int32_t> place(-100, 100);
  GridMap map(0.1);
  std::map<CellIndex, int> truth;
  for (int i = 0; i < 300; ++i) {
    const CellIndex cell{place(random), place(random) + 37};
    GridTile& tile = map.make(GridMap::tile_of(cell));
    const auto index = static_cast<std::size_t>(GridTile::index_of(cell));
    tile.state[index] = i % 2 == 0 ? VertexState::kFree : VertexState::kBlocked;
    tile.belief[index] = static_cast<std::uint8_t>(i % 256);
    tile.height[index] = static_cast<std::int16_t>(i);
    truth[cell] = i;
  }
  const MapRaster raster = rasterize(map);
  std::size_t seen = 0;
  for (int row = 0; row < raster.cells.height; ++row)
    for (int column = 0; column < raster.cells.width; ++column) {
      const CellIndex cell{raster.cells.first.ix + column, raster.cells.first.iy + row};
      const std::size_t at = raster.cells.index_of(cell);
      const auto known = truth.find(cell);
      if (known == truth.end()) {
        EXPECT_EQ(raster.state[at], VertexState::kUnknown);
        EXPECT_TRUE(std::isnan(raster.height_m[at]));
        continue;
      }
      ++seen;
      EXPECT_EQ(raster.state[at], known->second % 2 == 0 ? VertexState::kFree : VertexState::kBlocked);
      EXPECT_EQ(raster.belief[at], known->second % 256);
      EXPECT_NEAR(raster.height_m[at], known->second * 1e-4, 1e-7);
    }
  EXPECT_EQ(seen, truth.size());
}

TEST(Raster, OfAnEmptyMapIsOneUnknownCell) {
  const MapRaster raster = rasterize(GridMap(0.05));
  EXPECT_EQ(raster.cells.size(), 1U);
  EXPECT_EQ(raster.state.front(), VertexState::kUnknown);
}

}  // namespace
}  // namespace floornav
