#include "mapping/node/mapper_node.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "lcmtypes/channels.hpp"
#include "mapping/node/map_message_size.hpp"
#include "mapping/node/terrain_map_message.hpp"
#include "tests/mapping/made_evidence.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr Area kBox{1.5, 2.0, -0.25, 0.25};

template <class Message>
Message decoded(const EncodedMessage& encoded) {
  Message message;
  const int size = static_cast<int>(encoded.bytes.size());
  EXPECT_EQ(message.decode(encoded.bytes.data(), 0, size), size);
  return message;
}

/// A mapper with a bus of its own.
class Rig {
 public:
  explicit Rig(const MappingSettings& settings = {}) : node_(settings, RobotSettings{}) {
    node_.subscribe(inbox_);
  }

  template <class Message>
  void send(const char* channel, Message message) {
    if constexpr (requires { message.seq; }) {
      message.source = "sender";
      message.session = 5;
      message.seq = ++seq_[channel];
    }
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    inbox_.deliver(channel, bytes, now_);
    while (node_.step(now_, budget_, out_)) {
    }
    collect();
  }
  std::vector<surfels_t> parts_of(const FloorEvidence& evidence) {
    return to_messages(evidence, {"camera", 3, ++frame_, 1});
  }
  void see_frame(const FloorEvidence& evidence) {
    for (surfels_t& part : parts_of(evidence)) send(channel::kSurfels, std::move(part));
  }
  void pose(std::int64_t utime_us, double x_m) {
    pose_t pose{};
    pose.utime = utime_us;
    pose.pos[0] = x_m;
    pose.orientation[0] = 1;
    send(channel::kPose, pose);
  }
  void tick(int ticks = 1) {
    for (; ticks > 0; --ticks) {
      now_ += 100ms;
      node_.tick(now_, out_);
      collect();
    }
  }
  /// What was published on a channel since the last call.
  template <class Message>
  std::vector<Message> take(const char* channel) {
    std::vector<Message> messages;
    for (const EncodedMessage& message : published_)
      if (message.channel == channel) messages.push_back(decoded<Message>(message));
    std::erase_if(published_,
                  [channel](const EncodedMessage& message) { return message.channel == channel; });
    return messages;
  }
  std::int64_t malformed(const char* channel) { return inbox_.counts()[channel].malformed; }
  health_t health() const {
    health_t health{};
    node_.report(health);
    return health;
  }

 private:
  void collect() {
    for (EncodedMessage& message : out_.take()) {
      EXPECT_LE(message.bytes.size(), kMapMessageBytes);
      published_.push_back(std::move(message));
    }
  }

  MapperNode node_;
  Inbox inbox_;
  Outbox out_{Identity{"mapper", 7}};
  UnlimitedBudget budget_;
  Micros now_{0};
  std::map<std::string, std::int64_t> seq_;
  std::int64_t frame_ = 0;
  std::vector<EncodedMessage> published_;
};

void apply_all(Rig& rig, GridMapReceiver& receiver) {
  for (const grid_map_t& message : rig.take<grid_map_t>(channel::kGridMap)) receiver.apply(message);
}

void expect_same_states(const GridMap& a, const GridMap& b) {
  ASSERT_EQ(a.sorted_tiles(), b.sorted_tiles());
  for (const CellIndex index : a.sorted_tiles()) {
    EXPECT_EQ(a.find(index)->state, b.find(index)->state);
    EXPECT_EQ(a.find(index)->edges, b.find(index)->edges);
    EXPECT_EQ(a.find(index)->height, b.find(index)->height);
  }
}

GridMap map_of(const std::vector<FloorEvidence>& frames) {
  WorldMap world(MappingSettings{}, RobotSettings{});
  for (const FloorEvidence& frame : frames) {
    world.integrate(frame);
    world.refresh();
  }
  GridMap copy(world.grid().lattice().pitch_m);
  for (const CellIndex index : world.grid().sorted_tiles()) copy.make(index) = *world.grid().find(index);
  return copy;
}

std::vector<FloorEvidence> drive(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, 0.003F);
  std::vector<FloorEvidence> frames;
  for (int i = 0; i < 8; ++i) {
    FloorEvidence frame = see(with_block(flat(), kBox, 0.1), {0.1 * i, 2 + 0.2 * i, -1, 1});
    frame.utime_us += i * 33'000;
    for (CellEvidence& cell : frame.cells) cell.mean_z_m += noise(random);
    frames.push_back(frame);
  }
  return frames;
}

TEST(MapperNode, PublishesTheMapOfAFrameThatCameInParts) {
  Rig rig;
  const FloorEvidence frame = see(with_block(flat(), kBox, 0.1));
  ASSERT_GT(rig.parts_of(frame).size(), 2U);
  rig.see_frame(frame);
  GridMapReceiver receiver;
  apply_all(rig, receiver);
  expect_same_states(map_of({frame}), receiver.map());
  EXPECT_EQ(receiver.header().utime_us, frame.utime_us);
  EXPECT_FLOAT_EQ(receiver.header().step_m, 0.02F);
}

TEST(MapperNode, SaysEveryTickThatItLives) {
  Rig rig;
  rig.tick(3);
  EXPECT_EQ(rig.take<grid_map_t>(channel::kGridMap).size(), 3U);
  EXPECT_TRUE(rig.take<terrain_map_t>(channel::kTerrainMap).empty());
}

TEST(MapperNode, LateReceiverHasTheMapWithinTwoSeconds) {
  Rig rig;
  const FloorEvidence frame = see(with_block(flat(), kBox, 0.1), {-3, 4, -3, 3});
  rig.see_frame(frame);
  rig.take<grid_map_t>(channel::kGridMap);
  rig.tick(20);
  GridMapReceiver receiver;
  apply_all(rig, receiver);
  expect_same_states(map_of({frame}), receiver.map());
}

class LossyReceiver : public testing::TestWithParam<unsigned> {};

TEST_P(LossyReceiver, HasTheMapWithinTwoSecondsOfTheLastLoss) {
  Rig rig;
  std::mt19937 random(GetParam());
  GridMapReceiver receiver;
  const auto frames = drive(GetParam());
  for (const FloorEvidence& frame : frames) {
    rig.see_frame(frame);
    rig.tick();
    for (const grid_map_t& message : rig.take<grid_map_t>(channel::kGridMap))
      if (random() % 10 != 0) receiver.apply(message);
  }
  rig.tick(20);
  apply_all(rig, receiver);
  expect_same_states(map_of(frames), receiver.map());
}

TEST_P(LossyReceiver, MapDoesNotDependOnWhenTicksFall) {
  const auto frames = drive(GetParam());
  std::mt19937 random(GetParam());
  Rig ticking;
  for (const FloorEvidence& frame : frames) {
    for (surfels_t& part : ticking.parts_of(frame)) {
      ticking.send(channel::kSurfels, part);
      if (random() % 2 == 0) ticking.tick();
    }
  }
  GridMapReceiver receiver;
  ticking.tick(20);
  apply_all(ticking, receiver);
  expect_same_states(map_of(frames), receiver.map());
}

INSTANTIATE_TEST_SUITE_P(Seeds, LossyReceiver, testing::Range(1U, 6U));

TEST(MapperNode, FrameWhoseLastPartWasLostStillCounts) {
  Rig rig;
  auto parts = rig.parts_of(see(flat()));
  parts.pop_back();
  for (surfels_t& part : parts) rig.send(channel::kSurfels, part);
  EXPECT_TRUE(rig.take<grid_map_t>(channel::kGridMap).empty());
  rig.tick(4);
  GridMapReceiver receiver;
  apply_all(rig, receiver);
  EXPECT_EQ(receiver.map().state({5, 0}), VertexState::kFree);
}

TEST(MapperNode, PoseJumpStartsAnEmptyMapAndKeepsOldEvidenceOut) {
  Rig rig;
  rig.pose(900'000, 0);
  rig.see_frame(see(flat()));
  GridMapReceiver receiver;
  apply_all(rig, receiver);
  EXPECT_FALSE(receiver.map().tiles().empty());
  rig.pose(1'000'000, 0.05);
  rig.pose(1'100'000, 3.0);
  apply_all(rig, receiver);
  EXPECT_EQ(receiver.map().epoch, 1);
  EXPECT_TRUE(receiver.map().tiles().empty());

  rig.see_frame(see(flat()));  // of 1.0 s: before the jump
  apply_all(rig, receiver);
  EXPECT_TRUE(receiver.map().tiles().empty());
  const health_t health = rig.health();
  ASSERT_EQ(health.drops.size(), 1U);
  EXPECT_EQ(health.drops[0].cause, "SURFELS from before a pose jump");

  FloorEvidence later = see(flat(), {3, 5, -1, 1});
  later.utime_us = 1'200'000;
  rig.see_frame(later);
  apply_all(rig, receiver);
  EXPECT_EQ(receiver.map().state({80, 0}), VertexState::kFree);
}

rigid_transform_t local_to_global(std::int64_t utime_us, double x_m) {
  rigid_transform_t message{};
  message.utime = utime_us;
  message.trans[0] = x_m;
  message.quat[0] = 1;
  return message;
}

TEST(MapperNode, MapComesBackAfterAJumpWhereLocalToGlobalPutsIt) {
  Rig rig;
  rig.send(channel::kLocalToGlobal, local_to_global(800'000, 10));
  rig.pose(900'000, 0);
  rig.see_frame(see(flat(), {0, 2, -1, 1}));
  rig.pose(1'000'000, 5);
  rig.send(channel::kLocalToGlobal, local_to_global(950'000, 10));  // from before the jump
  rig.tick();
  GridMapReceiver receiver;
  apply_all(rig, receiver);
  EXPECT_TRUE(receiver.map().tiles().empty());
  EXPECT_NE(rig.health().reason.find("LOCAL_TO_GLOBAL"), std::string::npos);
  rig.send(channel::kLocalToGlobal, local_to_global(1'050'000, 5));
  rig.tick(2);
  apply_all(rig, receiver);
  const auto state_at = [&](double x_m) {
    return receiver.map().state(receiver.map().lattice().cell_of(x_m, 0.01));
  };
  EXPECT_EQ(state_at(5.1), VertexState::kFree);
  EXPECT_EQ(state_at(6.9), VertexState::kFree);
  EXPECT_EQ(state_at(4.9), VertexState::kUnknown);
  EXPECT_EQ(state_at(1.0), VertexState::kUnknown);
}

TEST(MapperNode, DriveWithinTheLimitsIsNoJump) {
  Rig rig;
  for (int i = 0; i < 50; ++i) rig.pose(1'000'000 + i * 100'000, 0.1 * i);
  rig.tick();
  EXPECT_EQ(rig.take<grid_map_t>(channel::kGridMap).back().epoch, 0);
}

TEST(MapperNode, ClockThatStepsBackIsNoJumpAndEvidenceGoesOn) {
  Rig rig;
  rig.pose(7'200'000'000, 0);
  rig.pose(7'200'100'000, 5);  // a jump
  rig.pose(500'000, 5);        // the clock is set back by two hours
  rig.see_frame(see(flat()));
  GridMapReceiver receiver;
  apply_all(rig, receiver);
  EXPECT_EQ(receiver.map().epoch, 1);
  EXPECT_EQ(receiver.map().state({5, 0}), VertexState::kFree);
}

TEST(MapperNode, SendsFarTilesOnRequest) {
  Rig rig;
  FloorEvidence far = see(flat(), {50, 52, 0, 1});
  far.T_world_body.translation().x() = 50;
  rig.see_frame(far);
  FloorEvidence here = see(flat());
  here.utime_us += 1'000'000'000;
  rig.see_frame(here);
  rig.take<grid_map_t>(channel::kGridMap);
  const auto has_far_tile = [&] {
    rig.tick(20);
    GridMapReceiver receiver;
    apply_all(rig, receiver);
    return receiver.map().state({1010, 5}) == VertexState::kFree;
  };
  EXPECT_FALSE(has_far_tile());
  map_request_t request{};
  request.center[0] = 51;
  request.radius = 1;
  rig.send(channel::kMapRequest, request);
  EXPECT_TRUE(has_far_tile());
  EXPECT_FALSE(has_far_tile());
  request.center[0] = 0;
  request.radius = -1;
  rig.send(channel::kMapRequest, request);
  EXPECT_TRUE(has_far_tile());
  request.radius = std::nan("");
  rig.send(channel::kMapRequest, request);
  EXPECT_EQ(rig.malformed(channel::kMapRequest), 1);
}

TEST(MapperNode, TerrainGoesOutOnceASecond) {
  Rig rig;
  rig.see_frame(see(with_block(flat(), kBox, 0.5)));
  rig.tick(30);
  const auto messages = rig.take<terrain_map_t>(channel::kTerrainMap);
  EXPECT_EQ(messages.size(), 3U);
  TerrainMapReceiver receiver;
  for (const terrain_map_t& message : messages) receiver.apply(message);
  EXPECT_NEAR(receiver.map().height_m(receiver.map().lattice().cell_of(1.7, 0.1)), 0.5, 1e-3);
  EXPECT_NEAR(receiver.map().height_m(receiver.map().lattice().cell_of(0.5, 0.1)), 0.0, 1e-3);
}

TEST(MapperNode, TellsOfEvidenceThatItCannotUse) {
  Rig rig;
  FloorEvidence frame = see(flat(), {0, 0.2, 0, 0.2}, 0.03);
  rig.see_frame(frame);
  EXPECT_EQ(rig.health().state, health_t::DEGRADED);
  EXPECT_NE(rig.health().reason.find("no integer multiple"), std::string::npos);

  surfels_t corrupt = rig.parts_of(see(flat(), {0, 0.2, 0, 0.2}))[0];
  corrupt.cells[0].surfel = 99;
  rig.send(channel::kSurfels, corrupt);
  EXPECT_EQ(rig.malformed(channel::kSurfels), 1);

  rig.see_frame(see(flat()));
  EXPECT_TRUE(rig.health().reason.empty());
  rig.tick(30);
  EXPECT_EQ(rig.health().state, health_t::DEGRADED);
}

}  // namespace
}  // namespace floornav
