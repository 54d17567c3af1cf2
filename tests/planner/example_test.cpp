#include <gtest/gtest.h>

#include "lcmtypes/channels.hpp"
#include "mapping/node/grid_map_message.hpp"
#include "planner/example/follow_path.hpp"
#include "planner/node/planner_node.hpp"
#include "tools/simulate/drive_base.hpp"
#include "tools/simulator/random_world.hpp"
#include "tools/simulator/true_route.hpp"
#include "tools/simulator/vehicle.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr double kTolerance_m = 0.2;

/// The truth as a mapper would publish it that had seen everything.
GridMap map_of(const TruthGrid& truth, const RobotSettings& robot) {
  GridMap map(truth.lattice.pitch_m);
  map.version = 1;
  const auto cell_at = [&](std::int32_t x, std::int32_t y) -> const TruthCell* {
    if (x < 0 || y < 0 || x >= truth.width || y >= truth.height) return nullptr;
    return &truth.cells[static_cast<std::size_t>(y * truth.width + x)];
  };
  for (std::int32_t y = 0; y < truth.height; ++y) {
    for (std::int32_t x = 0; x < truth.width; ++x) {
      const TruthCell& cell = *cell_at(x, y);
      const CellIndex index{truth.origin.ix + x, truth.origin.iy + y};
      GridTile& tile = map.make(GridMap::tile_of(index));
      const auto i = static_cast<std::size_t>(GridTile::index_of(index));
      tile.version = 1;
      tile.state[i] = cell.drivable ? VertexState::kFree : VertexState::kBlocked;
      tile.belief[i] = cell.drivable ? 255 : 0;
      tile.height[i] =
          static_cast<std::int16_t>(std::clamp(cell.height_m, -3.0F, 3.0F) / GridTile::kHeightUnit_m);
      for (unsigned k = 0; k < 8; ++k) {
        const TruthCell* const to = cell_at(x + kNeighbourX[k], y + kNeighbourY[k]);
        const bool open = to != nullptr && cell.drivable && to->drivable &&
                          std::abs(to->height_m - cell.height_m) <= static_cast<float>(robot.max_step_m);
        if (open) tile.edges[i] |= static_cast<std::uint8_t>(1U << k);
      }
    }
  }
  return map;
}

/// A planner that gets the whole map, and the example's controller on a drive that the true world stops.
class Drive {
 public:
  Drive(const RandomWorld& world, const RobotSettings& robot)
      : world_(world), planner_({}, robot), base_(robot, {}), map_(map_of(world.truth, robot)) {
    planner_.subscribe(inbox_);
  }

  /// What went wrong, or empty when the planner says that the goal is reached.
  std::string to_goal() {
    send_map(map_.sorted_tiles());
    for (; now_ < 200s; now_ += 10ms) {
      if (now_ % 50ms == 0s) sense();
      if (now_ % 80ms == 0s) planner_.tick(now_, out_);
      while (planner_.step(now_, budget_, out_)) {
      }
      for (const EncodedMessage& message : out_.take()) hear(message);
      const double heading = std::atan2(base_.state().ahead.y(), base_.state().ahead.x());
      const auto command =
          controller_.command(base_.state().position_m.x(), base_.state().position_m.y(), heading, seconds());
      base_.move({command.speed_mps, command.turn_radps}, 0.01);
      if (now_ % 50ms == 0s)
        if (std::string trouble = base_.trouble(world_.scene.fixed); !trouble.empty()) return trouble;
      if (path_.status == path_t::REACHED) return {};
    }
    return "did not arrive: " + path_.reason;
  }
  [[nodiscard]] const DriveBase& base() const { return base_; }

 private:
  [[nodiscard]] double seconds() const { return 1e-6 * static_cast<double>(now_.count()); }

  template <class Message>
  void deliver(const std::string& channel, Message message) {
    message.utime = 1 + now_.count();
    if constexpr (requires { message.session; })
      message.source = "test", message.session = 1, message.seq = ++seq_;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    inbox_.deliver(channel, bytes, now_);
    while (planner_.step(now_, budget_, out_)) {
    }
  }
  void send_map(const std::vector<CellIndex>& tiles) {
    for (const grid_map_t& message : to_messages(map_, tiles, {1 + now_.count(), 0.02F, Pose::Identity()}))
      deliver(channel::kGridMap, message);
  }
  void sense() {
    pose_t pose{};
    const Pose T_world_body = body_on_floor(world_.scene.fixed, base_.state());
    for (int i = 0; i < 3; ++i) pose.pos[i] = T_world_body.translation()[i];
    const Eigen::Quaterniond q(T_world_body.linear());
    pose.orientation[0] = q.w(), pose.orientation[1] = q.x(), pose.orientation[2] = q.y(),
    pose.orientation[3] = q.z();
    deliver(channel::kPose, pose);
    send_map({});
    goal_t goal{};
    goal.id = 1;
    goal.command = goal_t::GO;
    goal.pos[0] = world_.scene.goal_m->x();
    goal.pos[1] = world_.scene.goal_m->y();
    goal.tolerance = static_cast<float>(kTolerance_m);
    deliver(channel::kGoal, goal);
  }
  void hear(const EncodedMessage& message) {
    path_.decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size()));
    controller_.accept(path_, seconds());
  }

  const RandomWorld& world_;
  PlannerNode planner_;
  DriveBase base_;
  GridMap map_;
  Inbox inbox_;
  Outbox out_{Identity{"planner", 99}};
  UnlimitedBudget budget_;
  FollowPath controller_;
  path_t path_{};
  Micros now_{0};
  std::int64_t seq_ = 0;
};

TEST(ExampleController, DrivesThroughRandomRoomsOnAFullMapAlmostAsShortAsCanBe) {
  RobotSettings robot;
  robot.radius_m = 0.52;
  std::vector<double> ratios;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const RandomWorld world = random_world(seed, 0.5, 0, robot);
    Drive drive(world, robot);
    ASSERT_EQ(drive.to_goal(), "") << "seed " << seed;
    const double off_m = (drive.base().state().position_m - *world.scene.goal_m).norm();
    EXPECT_LE(off_m, kTolerance_m + 0.05) << "seed " << seed;
    const auto shortest_m =
        shortest_way_m(world.truth, robot.radius_m, {0, 0}, *world.scene.goal_m, kTolerance_m);
    ASSERT_TRUE(shortest_m);
    ratios.push_back(drive.base().travelled_m() / *shortest_m);
    RecordProperty("ratio_" + std::to_string(seed), std::to_string(ratios.back()));
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LE(ratios[ratios.size() / 2], 1.10);
}

}  // namespace
}  // namespace floornav
