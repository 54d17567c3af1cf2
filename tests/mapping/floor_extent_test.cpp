#include <gtest/gtest.h>

#include "tests/mapping/mapped_world.hpp"

namespace floornav {
namespace {

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

TEST(WorldMap, TooSteepASlopeIsBlocked) {
  const WorldMap map = mapped({see(ramp(12, 1.5, 2.5))});
  EXPECT_EQ(count(map, {1.5, 2.5, -1, 1}), (Counts{.blocked = 20 * 40}));
}

TEST(WorldMap, TheRobotsChassisAndItsTippingLimitWhatItsWheelsCouldTake) {
  const Scene step = [](double x_m, double) { return Ground{x_m > 2 ? 0.03 : 0.0}; };
  const Scene ramp = [](double x_m, double) { return Ground{0.15 * x_m, 0.15, 0}; };
  RobotSettings sturdy;
  sturdy.max_step_m = 0.035;
  sturdy.max_slope_deg = 12;
  RobotSettings low = sturdy;
  low.ground_clearance_m = 0.025;
  RobotSettings top_heavy = sturdy;
  top_heavy.center_of_gravity_m = 1.0;
  const auto free_at = [](const Scene& scene, const RobotSettings& robot, double x_m) {
    const WorldMap map = mapped({see(scene), see(scene), see(scene)}, {}, robot);
    return map.grid().state(map.grid().lattice().cell_of(x_m, 0.025)) == VertexState::kFree;
  };
  EXPECT_TRUE(free_at(step, sturdy, 3));
  EXPECT_FALSE(free_at(step, low, 3));
  EXPECT_TRUE(free_at(ramp, sturdy, 0.5));
  EXPECT_FALSE(free_at(ramp, top_heavy, 0.5));
}

TEST(WorldMap, GroundBelowAnEdgeAndItsRimAreBlocked) {
  const Area below{2.0, 4.0, -1, 1};
  const WorldMap map = mapped({see(with_block(flat(), below, -0.17))});
  EXPECT_EQ(count(map, below), (Counts{.blocked = 40 * 40}));
  EXPECT_EQ(count(map, {1.95, 2.0, -1, 1}), (Counts{.blocked = 40}));
  EXPECT_EQ(count(map, {0, 1.95, -1, 1}), (Counts{.free = 39 * 40}));
}

TEST(WorldMap, AStepALittleUnderTheLimitIsClosedUntilItsHeightIsCertain) {
  const Scene step = with_block(flat(), {2.0, 4.0, -1, 1}, 0.016);
  const auto edge = [&](int frames) {
    const WorldMap map = mapped(std::vector<FloorEvidence>(static_cast<std::size_t>(frames), see(step)));
    return edge_open(map, at(map, 1.975, 0.025), 0);
  };
  EXPECT_FALSE(edge(1));  // 3.6 mm each by view_sigma_m and the sensor
  EXPECT_TRUE(edge(30));
}

TEST(WorldMap, WhereSightLinesFallBelowTheFloorItEndsInADrop) {
  const Area unseen{2.0, 2.2, -1, 1};
  FloorEvidence frame = see(with_hole(flat(), unseen));
  for (std::int32_t iy = -20; iy < 20; ++iy)
    for (std::int32_t ix = 40; ix < 44; ++ix) {
      CellEvidence ray;
      ray.cell = {ix, iy};
      ray.ray_z_m = ix < 42 ? -0.015F : -0.045F;  // just behind the edge a ray has not fallen far
      frame.cells.push_back(ray);
    }
  const std::vector<FloorEvidence> twice(2, frame);
  EXPECT_EQ(count(mapped(twice), unseen), (Counts{.unknown = 4 * 40}));
  const WorldMap map = mapped(std::vector<FloorEvidence>(4, frame));
  EXPECT_EQ(count(map, {2.1, 2.2, -1, 1}), (Counts{.blocked = 2 * 40}));
  EXPECT_EQ(count(map, {2.2, 2.25, -1, 1}).free, 0);  // what lies beside a drop
  EXPECT_EQ(count(map, {0, 2.0, -1, 1}), (Counts{.free = 40 * 40}));
}

TEST(WorldMap, SidesOfARampAreBlockedWhereTheyAreHigherThanAStep) {
  const Area on_ramp{1.2, 3.2, -0.5, 0.5};
  const Scene uphill = ramp(5, 1.2, 3.2);
  const Scene scene = [=](double x_m, double y_m) {
    return inside(x_m, y_m, on_ramp) || x_m > 3.2 ? uphill(x_m, y_m) : Ground{};
  };
  const WorldMap map = mapped({see(scene)});
  const double high_m = 1.2 + 0.02 / std::tan(5 * std::numbers::pi / 180) + 0.15;  // and 3 sigma
  EXPECT_EQ(count(map, {high_m, 3.2, 0.45, 0.5}).free, 0);
  EXPECT_EQ(count(map, {high_m, 3.2, -0.5, -0.45}).free, 0);
  EXPECT_EQ(count(map, {1.2, 3.2, -0.4, 0.4}).blocked, 0);
  EXPECT_EQ(count(map, {0.0, 3.2, 0.5, 1.0}).blocked + count(map, {0.0, 3.2, -1.0, -0.5}).blocked, 0);
}

TEST(WorldMap, FarFloorBehindUnknownGroundIsFree) {
  const WorldMap map = mapped({see(with_hole(flat(), {1.5, 2.5, -2, 2}))});
  EXPECT_EQ(count(map, {2.5, 4, -1, 1}), (Counts{.free = 30 * 40}));
}

TEST(WorldMap, RampSeenBehindUnknownGroundIsFreeButABoxIsNot) {
  const Area hole{1.2, 1.4, -2, 2};
  EXPECT_EQ(count(mapped({see(with_hole(ramp(6, 1.0, 3.0), hole))}), {1.4, 4, -1, 1}).blocked, 0);
  const Area box{1.4, 2.0, -1, 1};
  EXPECT_EQ(count(mapped({see(with_hole(with_block(flat(), box, 0.1), hole))}), box).free, 0);
}

TEST(WorldMap, RoomBehindAWallOnTheSameLevelIsFree) {
  const WorldMap map = mapped({see(with_block(flat(), {2.0, 2.1, -2, 2}, 0.5))});
  EXPECT_EQ(count(map, {2.0, 2.1, -1, 1}), (Counts{.blocked = 2 * 40}));
  EXPECT_EQ(count(map, {2.1, 4, -1, 1}), (Counts{.free = 38 * 40}));
}

TEST(WorldMap, FloorIsWhatTheRobotStandsOnNotZero) {
  FloorEvidence frame = see(with_block(flat(5.0), kBox, 5.1));
  frame.T_world_body.translation().z() = 5.0;
  const WorldMap map = mapped({frame});
  EXPECT_EQ(count(map, {}), (Counts{.free = 80 * 40 - 100, .blocked = 100}));
  EXPECT_EQ(belief_at(map, 1, 0), 1.0F);
  EXPECT_NEAR(belief_at(map, 1.75, 0), 1 - 0.1 / 0.75, 0.003);
}

TEST(WorldMap, FloorAFewCentimetresOffTheBodyIsStillTheFloor) {
  const WorldMap map = mapped({see(with_block(flat(-0.05), kBox, 0.05))});
  EXPECT_EQ(count(map, kBox), (Counts{.blocked = 100}));
  EXPECT_EQ(count(map, {}).free, 80 * 40 - 100);
}

}  // namespace
}  // namespace floornav
