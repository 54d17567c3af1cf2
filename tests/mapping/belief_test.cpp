#include "mapping/belief.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "mapping/robot_limits.hpp"

namespace floornav {
namespace {

struct Row {
  float height_m;
  float slope_deg;
  float belief;
};

class BeliefTable : public testing::TestWithParam<Row> {};

// Worked out by hand from section 4.6.
TEST_P(BeliefTable, IsAsInSection46) {
  EXPECT_NEAR(belief(GetParam().height_m, GetParam().slope_deg), GetParam().belief, 1e-6F);
}

INSTANTIATE_TEST_SUITE_P(Rows, BeliefTable,
                         testing::Values(Row{0, 0, 1}, Row{0.375F, 0, 0.5F}, Row{-0.375F, 0, 0.5F},
                                         Row{0.15F, 0, 0.8F}, Row{0.75F, 0, 0}, Row{-0.75F, 0, 0},
                                         Row{1.5F, 0, 0}, Row{-1.5F, 0, 0}, Row{0, 15, 0.8F},
                                         Row{0, 30, 0.6F}, Row{0, 45, 0.4F}, Row{0, 60, 0.2F},
                                         Row{0, 67.5F, 0.1F}, Row{0, 75, 0}, Row{0, 90, 0},
                                         Row{0.375F, 30, 0.3F}, Row{-0.15F, 60, 0.16F}));

TEST(LeastBelief, FollowsFromSlopeLimitCentreOfGravityAndSpeed) {
  RobotSettings robot;
  const double rise = std::tan(10 * std::numbers::pi / 180);
  EXPECT_NEAR(least_belief(robot), (1 - 0.8 * 10 / 60) * (1 - 1.6 * rise / 0.75), 1e-5);
  RobotSettings gentle = robot;
  gentle.max_slope_deg = 5;
  EXPECT_GT(least_belief(gentle), least_belief(robot));
  RobotSettings top_heavy = robot;
  top_heavy.center_of_gravity_m = 1.0;
  EXPECT_GT(least_belief(top_heavy), least_belief(robot));
  RobotSettings quick = top_heavy;
  quick.max_speed_mps = 1.5;
  EXPECT_GT(least_belief(quick), least_belief(top_heavy));
}

}  // namespace
}  // namespace floornav
