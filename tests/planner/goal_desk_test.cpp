#include "planner/node/goal_desk.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace floornav {
namespace {

goal_t message(std::int64_t id, std::int8_t command = goal_t::GO, double x_m = 1) {
  goal_t goal{};
  goal.id = id;
  goal.command = command;
  goal.pos[0] = x_m;
  goal.tolerance = 0.2F;
  return goal;
}

using State = GoalDesk::State;

TEST(GoalDesk, TakesANewIdOnceAndItsRepetitionsNot) {
  GoalDesk desk;
  EXPECT_EQ(desk.id(), 0);
  EXPECT_TRUE(desk.accept(message(7)));
  EXPECT_FALSE(desk.accept(message(7)));
  EXPECT_EQ(desk.state(), State::kActive);
  EXPECT_EQ(desk.id(), 7);
  EXPECT_TRUE(desk.accept(message(8, goal_t::GO, 5)));
  EXPECT_EQ(desk.goal().x_m, 5);
}

TEST(GoalDesk, NeverStartsACancelledGoalAgain) {
  GoalDesk desk;
  desk.accept(message(7));
  EXPECT_TRUE(desk.accept(message(7, goal_t::CANCEL)));
  EXPECT_FALSE(desk.accept(message(7)));
  EXPECT_EQ(desk.state(), State::kCancelled);
  desk.accept(message(8));
  EXPECT_FALSE(desk.accept(message(7))) << "a late repetition of an older goal";
  EXPECT_EQ(desk.id(), 8);
}

TEST(GoalDesk, ACancelThatOvertakesItsGoalCancelsIt) {
  GoalDesk desk;
  EXPECT_TRUE(desk.accept(message(7, goal_t::CANCEL)));
  EXPECT_EQ(desk.id(), 7);
  EXPECT_FALSE(desk.accept(message(7)));
  EXPECT_EQ(desk.state(), State::kCancelled);
}

TEST(GoalDesk, ACancelOfAnotherGoalLeavesTheActiveOneAlone) {
  GoalDesk desk;
  desk.accept(message(7));
  EXPECT_FALSE(desk.accept(message(9, goal_t::CANCEL)));
  EXPECT_EQ(desk.state(), State::kActive);
  EXPECT_FALSE(desk.accept(message(9)));
  EXPECT_EQ(desk.id(), 7);
}

TEST(GoalDesk, AReachedGoalStaysReached) {
  GoalDesk desk;
  desk.accept(message(7));
  desk.reached();
  EXPECT_FALSE(desk.accept(message(7)));
  EXPECT_FALSE(desk.accept(message(7, goal_t::CANCEL)));
  EXPECT_EQ(desk.state(), State::kReached);
}

TEST(GoalDesk, RefusesWhatIsNoGoal) {
  GoalDesk desk;
  EXPECT_THROW(desk.accept(message(0)), std::invalid_argument);
  EXPECT_THROW(desk.accept(message(1, 3)), std::invalid_argument);
  EXPECT_THROW(desk.accept(message(1, goal_t::GO, std::numeric_limits<double>::quiet_NaN())),
               std::invalid_argument);
  EXPECT_THROW(desk.accept(message(1, goal_t::GO, 1e300)), std::invalid_argument);
  goal_t goal = message(1);
  goal.tolerance = -1;
  EXPECT_THROW(desk.accept(goal), std::invalid_argument);
  EXPECT_EQ(desk.state(), State::kIdle);
}

}  // namespace
}  // namespace floornav
