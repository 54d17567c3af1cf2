#include <cmath>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>

#include "perception/floor_perception.hpp"
#include "tests/perception/rendered_scene.hpp"

namespace floornav {
namespace {

const Eigen::AlignedBox2d kRectangle{Eigen::Vector2d(1.6, -0.31), Eigen::Vector2d(2.1, 0.33)};

Box over_rectangle(double low_m, double high_m) {
  return {{kRectangle.min().x(), kRectangle.min().y(), low_m},
          {kRectangle.max().x(), kRectangle.max().y(), high_m}};
}

/// How many level cells are told to be on an edge.
struct Told {
  int cut = 0, cut_told = 0;      ///< through which a near part of the rectangle's border goes
  int whole = 0, whole_told = 0;  ///< ten centimetres and more away from the rectangle
  int floor_told = 0;             ///< of the floor, anywhere
};

/// Which share of a cell lies in the rectangle, by a hundred places in it.
double share_inside(const Eigen::Vector2d& middle, double pitch_m, const Eigen::Rotation2Dd& to_scene) {
  constexpr int kSide = 10;
  int inside = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Eigen::Vector2d offset((i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5);
    inside += kRectangle.contains(to_scene * (middle + pitch_m * offset)) ? 1 : 0;
  }
  return static_cast<double>(inside) / (kSide * kSide);
}

/// The robot is told to be turned, so that the cells lie across the scene.
Told look(RenderedScene& scene, double turn_deg, const RobotSettings& robot = {}) {
  scene.mount(0.9, 25.0);
  const Eigen::AngleAxisd turn(turn_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
  Serial serial;
  FloorPerception perception({}, robot);
  const FloorEvidence& evidence =
      perception.process(scene.render(), Pose(turn), serial, [](std::int64_t) { return true; });
  Told told;
  for (const CellEvidence& cell : evidence.cells) {
    if (cell.surfel < 0) continue;
    const Surfel& surfel = evidence.surfels[static_cast<std::size_t>(cell.surfel)];
    if (surfel.normal.z() < 0.9F) continue;
    told.floor_told += surfel.dominant && cell.on_edge ? 1 : 0;
    const Eigen::Vector2d middle(evidence.lattice.center_of(cell.cell.ix),
                                 evidence.lattice.center_of(cell.cell.iy));
    const Eigen::Rotation2Dd to_scene(-turn.angle());
    const Eigen::Vector2d place = to_scene * middle;
    const double share = share_inside(middle, evidence.lattice.pitch_m, to_scene);
    if (share > 0.03 && share < 0.97 && place.x() < kRectangle.center().x()) {
      ++told.cut;
      told.cut_told += cell.on_edge ? 1 : 0;
    } else if (kRectangle.exteriorDistance(place) > 0.1) {
      ++told.whole;
      told.whole_told += cell.on_edge ? 1 : 0;
    }
  }
  return told;
}

void expect_edges_alone(const Told& told) {
  EXPECT_GE(told.cut, 4);
  EXPECT_GE(told.cut_told, 0.75 * told.cut) << told.cut;
  EXPECT_GT(told.whole, 1000);
  EXPECT_LE(told.whole_told, 0.005 * told.whole);
}

class OnEdge : public testing::TestWithParam<std::tuple<double, unsigned>> {
 protected:
  OnEdge() { scene_.seed = std::get<1>(GetParam()); }
  Told look() { return floornav::look(scene_, std::get<0>(GetParam())); }

  RenderedScene scene_;
};

TEST_P(OnEdge, IsWhatTheSideOfABoxGoesThrough) {
  scene_.boxes.push_back(over_rectangle(0.0, 0.08));
  expect_edges_alone(look());
}

TEST_P(OnEdge, IsFloorOfWhichAPartIsMissing) {
  scene_.hole = over_rectangle(0.0, 0.0);
  scene_.boxes.push_back({{-5, -5, -0.4}, {5, 5, -0.3}});
  expect_edges_alone(look());
}

TEST_P(OnEdge, IsADropThatTheWheelsTakeAndTheChassisDoesNotClear) {
  RobotSettings robot;
  robot.max_step_m = 0.5;
  robot.ground_clearance_m = 0.02;
  scene_.hole = over_rectangle(0.0, 0.0);
  scene_.boxes.push_back({{-5, -5, -0.4}, {5, 5, -0.3}});
  expect_edges_alone(floornav::look(scene_, std::get<0>(GetParam()), robot));
}

TEST_P(OnEdge, IsNotTheFloorBeforeALowStepThatTheRobotClimbs) {
  scene_.boxes.push_back(over_rectangle(0.0, 0.012));
  EXPECT_EQ(look().floor_told, 0);
}

TEST_P(OnEdge, IsNotTheFloorUnderATableTop) {
  scene_.boxes.push_back(over_rectangle(0.55, 0.6));
  EXPECT_EQ(look().floor_told, 0);
}

INSTANTIATE_TEST_SUITE_P(Turns, OnEdge,
                         testing::Combine(testing::Values(12.0, 35.0, -20.0), testing::Values(1U, 2U)));

}  // namespace
}  // namespace floornav
