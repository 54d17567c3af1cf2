#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

struct Pitches {
  double pitch_m;
  double resolution_m;
};

class Resolutions : public testing::TestWithParam<Pitches> {
 protected:
  static MappingSettings settings() {
    MappingSettings settings;
    settings.resolution_m = GetParam().resolution_m;
    settings.terrain_resolution_m = 4 * GetParam().resolution_m;
    return settings;
  }
};

TEST_P(Resolutions, RampOfFiveDegreesIsFreeAndLeadsUp) {
  const Area area{0, 6, -1.2, 1.2};
  const Scene scene = ramp(5, 1.2, 4.8);
  const WorldMap map = mapped({see(scene, area, GetParam().pitch_m)}, settings());
  const Counts counts = count(map, area);
  EXPECT_EQ(counts.blocked, 0);
  EXPECT_EQ(counts.unknown, 0);
  EXPECT_NEAR(height_at(map, 5.5, 0), 3.6 * std::tan(5 * std::numbers::pi / 180), 2e-3);
  for (CellIndex vertex = at(map, 0.1, 0); vertex.ix < at(map, 5.9, 0).ix; ++vertex.ix)
    EXPECT_TRUE(edge_open(map, vertex, 0)) << vertex.ix;
}

TEST_P(Resolutions, BoxOnTheFloorIsBlocked) {
  const Area area{0, 3.6, -1.2, 1.2};
  const Area box{1.2, 2.4, -0.6, 0.6};
  const WorldMap map = mapped({see(with_block(flat(), box, 0.1), area, GetParam().pitch_m)}, settings());
  const Counts in_box = count(map, box);
  EXPECT_EQ(in_box.free + in_box.unknown, 0);
  const Counts all = count(map, area);
  EXPECT_EQ(all.blocked, in_box.blocked);
  EXPECT_EQ(all.unknown, 0);
}

TEST_P(Resolutions, LowStepIsFreeAndHighStepIsCutOff) {
  const Area area{0, 3.6, -1.2, 1.2};
  const Area upper{2.4, 3.6, -1.2, 1.2};
  const auto states = [&](double step_m) {
    return count(mapped({see(with_block(flat(), upper, step_m), area, GetParam().pitch_m)}, settings()),
                 upper);
  };
  EXPECT_EQ(states(0.014).blocked, 0);
  EXPECT_EQ(states(0.014).unknown, 0);
  EXPECT_EQ(states(0.025).free, 0);
  EXPECT_EQ(states(0.025).unknown, 0);
}

INSTANTIATE_TEST_SUITE_P(All, Resolutions,
                         testing::Values(Pitches{0.05, 0.05}, Pitches{0.025, 0.025}, Pitches{0.025, 0.05},
                                         Pitches{0.05, 0.1}, Pitches{0.1, 0.1}, Pitches{0.05, 0.2},
                                         Pitches{0.05, 0.3}),
                         [](const auto& info) {
                           return std::to_string(std::lround(1000 * info.param.pitch_m)) + "mm_in_" +
                                  std::to_string(std::lround(1000 * info.param.resolution_m)) + "mm";
                         });

}  // namespace
}  // namespace floornav
