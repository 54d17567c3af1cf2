#include "tools/simulate/path_follower.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tools/simulate/drive_base.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

/// A corner: 3 m ahead, then 3 m to the left; stops at its end.
path_t corner_path() {
  path_t path{};
  path.status = path_t::FOLLOWING;
  path.valid_for_ms = 250;
  for (int i = 0; i <= 60; ++i) {
    path_point_t point{};
    point.x = i <= 30 ? 0.1F * static_cast<float>(i) : 3.0F;
    point.y = i <= 30 ? 0.0F : 0.1F * static_cast<float>(i - 30);
    const float left_m = 0.1F * static_cast<float>(60 - i);
    point.speed = std::min(0.6F, std::sqrt(2.0F * 0.4F * left_m));
    path.points.push_back(point);
  }
  path.n_points = static_cast<std::int32_t>(path.points.size());
  return path;
}

TEST(PathFollower, GoesRoundACornerAndStopsAtTheEnd) {
  const RobotSettings robot;
  PathFollower follower(robot);
  DriveBase base(robot, {});
  double farthest_m = 0;
  for (Micros now{0}; now < 30s; now += 20ms) {
    follower.accept(corner_path(), now);
    base.move(follower.command(base.state(), base.speed_mps(), now), 0.02);
    const Eigen::Vector2d p = base.state().position_m;
    const double beside = std::min(std::hypot(std::max(0.0, p.x() - 3.0), p.y()),
                                   std::hypot(p.x() - 3.0, std::min(0.0, p.y())));
    farthest_m = std::max(farthest_m, beside);
  }
  EXPECT_LT((base.state().position_m - Eigen::Vector2d(3, 3)).norm(), 0.15);
  EXPECT_LT(base.speed_mps(), 0.02);
  EXPECT_LT(farthest_m, 0.25);
}

TEST(PathFollower, StandsStillWithoutAValidPath) {
  const RobotSettings robot;
  PathFollower follower(robot);
  EXPECT_EQ(follower.command({}, 0.5, 0us).speed_mps, 0.0);
  follower.accept(corner_path(), 0us);
  EXPECT_GT(follower.command({}, 0.5, 200ms).speed_mps, 0.0);
  EXPECT_EQ(follower.command({}, 0.5, 251ms).speed_mps, 0.0);
  path_t stop = corner_path();
  stop.status = path_t::STALE_MAP;
  follower.accept(stop, 300ms);
  EXPECT_EQ(follower.command({}, 0.5, 310ms).speed_mps, 0.0);
}

TEST(PathFollower, TurnsOnTheSpotTowardsAPathBehind) {
  const RobotSettings robot;
  PathFollower follower(robot);
  follower.accept(corner_path(), 0us);
  const DriveCommand command = follower.command({{1.0, 0.0}, {-1.0, 0.05}}, 0.0, 10ms);
  EXPECT_EQ(command.speed_mps, 0.0);
  EXPECT_NE(command.turn_radps, 0.0);
}

TEST(PathFollower, LooksAroundWhereThereIsNoWayAndNotWhereSomethingTouchesIt) {
  const RobotSettings robot;
  PathFollower follower(robot);
  path_t none{};
  none.valid_for_ms = 250;
  none.status = path_t::NO_PATH;
  follower.accept(none, 0us);
  EXPECT_NE(follower.command({}, 0.0, 10ms).turn_radps, 0.0);
  none.status = path_t::START_BLOCKED;
  follower.accept(none, 20ms);
  EXPECT_EQ(follower.command({}, 0.0, 30ms).turn_radps, 0.0);
}

TEST(PathFollower, TurnsARobotThatIsNoCircleOnlyWhereItsCircleHasRoom) {
  RobotSettings robot;
  robot.footprint = {{0.4, 0.2}, {-0.4, 0.2}, {-0.4, -0.2}, {0.4, -0.2}};
  path_t none{};
  none.valid_for_ms = 250;
  none.status = path_t::NO_PATH;
  for (const bool roomy : {false, true}) {
    PathFollower follower(robot);
    follower.accept(none, 0us);
    EXPECT_EQ(follower.command({}, 0.0, 10ms).turn_radps, 0.0) << "no path has told of any room yet";
    path_t path = corner_path();
    for (path_point_t& point : path.points) point.clearance = roomy ? 0.6F : 0.3F;
    follower.accept(path, 20ms);
    follower.accept(none, 30ms);
    EXPECT_EQ(follower.command({}, 0.0, 40ms).turn_radps != 0.0, roomy);
    EXPECT_EQ(follower.command({{9, 9}, {1, 0}}, 0.0, 50ms).turn_radps, 0.0);
  }
}

TEST(PathFollower, ComesToRestBeforeItLooksAround) {
  PathFollower follower(RobotSettings{});
  path_t none{};
  none.valid_for_ms = 250;
  none.status = path_t::NO_PATH;
  follower.accept(none, 0us);
  EXPECT_EQ(follower.command({}, 0.5, 10ms).turn_radps, 0.0);
  EXPECT_NE(follower.command({}, 0.0, 20ms).turn_radps, 0.0);
}

TEST(PathFollower, TurnsOnceAroundItselfAtTheFrontierTowardsThePathsHeading) {
  const RobotSettings robot;
  PathFollower follower(robot);
  DriveBase base(robot, {});
  path_t path = corner_path();
  path.status = path_t::FRONTIER;
  path.points.resize(1);
  path.points[0].heading = -1.0F;
  path.n_points = 1;
  double turned_rad = 0;
  for (Micros now{0}; now < 20s; now += 20ms) {
    follower.accept(path, now);
    const DriveCommand command = follower.command(base.state(), base.speed_mps(), now);
    EXPECT_EQ(command.speed_mps, 0.0);
    EXPECT_LE(command.turn_radps, 0.0);
    base.move(command, 0.02);
    turned_rad += base.turn_radps() * 0.02;
  }
  EXPECT_NEAR(turned_rad, -2.0 * M_PI, 0.2);
  EXPECT_EQ(base.turn_radps(), 0.0);
}

}  // namespace
}  // namespace floornav
