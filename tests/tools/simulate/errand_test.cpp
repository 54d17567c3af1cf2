#include "tools/simulate/errand.hpp"

#include <gtest/gtest.h>

namespace floornav {
namespace {

using namespace std::chrono_literals;

path_t path_of(const Errand& errand, std::int8_t status) {
  path_t path{};
  path.goal_id = errand.goal(0).id;
  path.status = status;
  return path;
}

/// The robot stands and hears the same for longer than it waits.
void stand(Errand& errand, std::int8_t status, const Eigen::Vector2d& place_m) {
  const path_t path = path_of(errand, status);
  for (Micros now{0}; now <= 2s && errand.goal(0).id == path.goal_id; now += 50ms)
    errand.follow(path, place_m, false, now);
}

TEST(Errand, SendsItsGoalUntilItIsReached) {
  Errand errand({4, 1}, 0.2);
  const goal_t goal = errand.goal(77);
  EXPECT_EQ(goal.utime, 77);
  EXPECT_EQ(goal.command, goal_t::GO);
  EXPECT_EQ(goal.pos[0], 4.0);
  EXPECT_FLOAT_EQ(goal.tolerance, 0.2F);
  stand(errand, path_t::FOLLOWING, {0, 0});
  EXPECT_EQ(errand.goal(0).id, goal.id);
  EXPECT_FALSE(errand.done(path_of(errand, path_t::FOLLOWING)));
  EXPECT_TRUE(errand.done(path_of(errand, path_t::REACHED)));
}

TEST(Errand, GoesAsNearAsItCanToAGoalThatIsShutOffAndAsksAgainOnceItHasLooked) {
  Errand errand({4, 1}, 0.2);
  stand(errand, path_t::NO_PATH, {0, 0});
  EXPECT_FLOAT_EQ(errand.goal(0).tolerance, 1.0F);
  stand(errand, path_t::GOAL_BLOCKED, {0, 0});
  const goal_t wide = errand.goal(0);
  EXPECT_FLOAT_EQ(wide.tolerance, 2.0F);
  EXPECT_EQ(wide.pos[0], 4.0);
  EXPECT_FALSE(errand.looks_around());
  EXPECT_FALSE(errand.done(path_of(errand, path_t::REACHED))) << "that is not the goal";
  errand.follow(path_of(errand, path_t::REACHED), {2, 1}, false, 5s);
  EXPECT_TRUE(errand.looks_around());
  errand.has_looked();
  EXPECT_FALSE(errand.looks_around());
  EXPECT_GT(errand.goal(0).id, wide.id);
  EXPECT_FLOAT_EQ(errand.goal(0).tolerance, 0.2F);
}

TEST(Errand, GoesAMetreBackWhereTheFloorAheadCannotBeSeen) {
  Errand errand({4, 1}, 0.2);
  const path_t following = path_of(errand, path_t::FOLLOWING);
  for (int i = 0; i <= 150; ++i) errand.follow(following, {0.02 * i, 0.5}, true, i * 20ms);
  stand(errand, path_t::FRONTIER, {3.0, 0.5});
  EXPECT_NEAR(errand.goal(0).pos[0], 1.9, 0.15);
  EXPECT_NEAR(errand.goal(0).pos[1], 0.5, 1e-9);
}

TEST(Errand, WaitsWhileTheRobotMovesAndDoesNotMindAnswersToOtherGoals) {
  Errand errand({4, 1}, 0.2);
  path_t path = path_of(errand, path_t::NO_PATH);
  for (Micros now{0}; now <= 5s; now += 50ms) errand.follow(path, {0, 0}, true, now);
  EXPECT_EQ(errand.goal(0).id, path.goal_id);
  path.goal_id += 1;
  for (Micros now{0}; now <= 5s; now += 50ms) errand.follow(path, {0, 0}, false, now);
  EXPECT_NE(errand.goal(0).id, path.goal_id);
}

TEST(Errand, GivesUpAfterSomeTries) {
  Errand errand({4, 1}, 0.2);
  for (int i = 0; i < 20; ++i) stand(errand, path_t::NO_PATH, {0, 0});
  const std::int64_t last = errand.goal(0).id;
  stand(errand, path_t::NO_PATH, {0, 0});
  EXPECT_EQ(errand.goal(0).id, last);
  EXPECT_FLOAT_EQ(errand.goal(0).tolerance, 0.2F) << "the last word is on the goal itself";
}

}  // namespace
}  // namespace floornav
