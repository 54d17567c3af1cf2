#include "planner/node/goal_desk.hpp"

#include <limits>
#include <numbers>
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

Pose shifted(double x_m, double heading_rad = 0) {
  Pose pose = Pose::Identity();
  pose.translate(Eigen::Vector3d(x_m, 0, 0)).rotate(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
  return pose;
}

TEST(GoalDesk, GoalStaysWhereItIsInTheGlobalFrame) {
  GoalDesk desk;
  desk.accept(message(7, goal_t::GO, 2));
  EXPECT_FALSE(desk.take(shifted(10))) << "the first one tells where the goal lies";
  EXPECT_FALSE(desk.take(shifted(10.005)));
  EXPECT_TRUE(desk.take(shifted(9)));
  EXPECT_NEAR(desk.goal().x_m, 3, 1e-9);
  EXPECT_TRUE(desk.take(shifted(10, 0.5 * std::numbers::pi)));
  EXPECT_NEAR(desk.goal().x_m, 0, 1e-9);
  EXPECT_NEAR(desk.goal().y_m, -2, 1e-9);
  EXPECT_EQ(desk.goal().tolerance_m, static_cast<double>(0.2F));
}

TEST(GoalDesk, NewGoalIsAnchoredByTheTransformOfItsDay) {
  GoalDesk desk;
  desk.take(shifted(10));
  desk.accept(message(7, goal_t::GO, 2));
  desk.take(shifted(11));
  EXPECT_NEAR(desk.goal().x_m, 1, 1e-9);
  desk.accept(message(8, goal_t::GO, 5));
  EXPECT_TRUE(desk.take(shifted(10)));
  EXPECT_NEAR(desk.goal().x_m, 6, 1e-9);
}

TEST(GoalDesk, TransformThatMovesTheGoalOutOfTheWorldIsRefused) {
  GoalDesk desk;
  desk.accept(message(7, goal_t::GO, 2));
  desk.take(shifted(0));
  EXPECT_THROW(desk.take(shifted(1e9)), std::invalid_argument);
  EXPECT_EQ(desk.goal().x_m, 2);
}

}  // namespace
}  // namespace floornav
