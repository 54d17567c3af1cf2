#include "perception/node/perception_node.hpp"

#include <map>

#include <gtest/gtest.h>

#include "floornav/surfels_t.hpp"
#include "lcmtypes/channels.hpp"
#include "lcmtypes/depth_cloud.hpp"
#include "perception/node/surfels_message.hpp"
#include "tests/perception/rendered_scene.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

/// A node with its inbox, and senders of its inputs.
class PerceptionNodeTest : public testing::Test {
 protected:
  PerceptionNodeTest() {
    scene_.camera = {131.25F, 131.25F, 79.5F, 59.5F, 160, 120};
    scene_.baseline_m = 0.3F;
    scene_.mount(0.9, 25.0);
    scene_.render();
    node_.subscribe(inbox_);
  }

  template <class Message>
  void deliver(const char* channel, const Message& message, Micros now) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    ASSERT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())),
              static_cast<int>(bytes.size()));
    inbox_.deliver(channel, bytes, now);
  }

  depth_cloud_t cloud(std::int64_t utime_us, std::int64_t frame, int first_row = 0, int rows = 120) {
    depth_cloud_t m{};
    m.utime = utime_us;
    m.source = "kinect";
    m.session = 11;
    m.seq = ++seq_;
    m.sensor = depth_cloud_t::KINECT;
    m.frame = frame;
    m.width = 160;
    m.height = 120;
    m.first_row = static_cast<std::int16_t>(first_row);
    m.rows = static_cast<std::int16_t>(rows);
    m.fx = scene_.camera.fx;
    m.fy = scene_.camera.fy;
    m.cx = scene_.camera.cx;
    m.cy = scene_.camera.cy;
    m.baseline = scene_.baseline_m;
    m.disparity_sigma = 0.067F;
    pose_to_arrays(scene_.T_body_sensor, m.sensor_pos, m.sensor_orientation);
    m.meaning = depth_cloud_t::DEPTH;
    m.scale = 0.001F;
    m.uncertainty_scale = 0;
    m.uncertainty_size = 0;
    pack_pixels(std::span(scene_.pixels)
                    .subspan(static_cast<std::size_t>(first_row) * 160, static_cast<std::size_t>(rows) * 160),
                m);
    return m;
  }

  void send_cloud(std::int64_t utime_us, Micros now) {
    deliver(channel::kKinectCloud, cloud(utime_us, ++frame_), now);
  }

  void send_pose(std::int64_t utime_us, double x, Micros now) {
    pose_t m{};
    m.utime = utime_us;
    m.pos[0] = x;
    m.orientation[0] = 1.0;
    deliver(channel::kPose, m, now);
  }

  /// Steps until idle; the first part of each frame published.
  std::vector<EvidencePart> step(Micros now) {
    UnlimitedBudget budget;
    while (node_.step(now, budget, out_)) {
    }
    std::vector<EvidencePart> frames;
    for (const EncodedMessage& message : out_.take()) {
      EXPECT_EQ(message.channel, channel::kSurfels);
      surfels_t surfels;
      EXPECT_GT(surfels.decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size())), 0);
      const EvidencePart part = to_evidence(surfels);
      if (part.part == 0) frames.push_back(part);
    }
    return frames;
  }

  std::int64_t dropped(const std::string& cause) {
    health_t health{};
    health.state = health_t::OK;
    node_.report(health);
    state_ = health.state;
    for (const drop_t& drop : health.drops)
      if (drop.cause == cause) return drop.count;
    return 0;
  }

  RenderedScene scene_;
  Serial serial_;
  PerceptionNode node_{{}, {}, serial_};
  Inbox inbox_;
  Outbox out_{{"perception", 3}};
  std::int64_t seq_ = 0;
  std::int64_t frame_ = 0;
  std::int8_t state_ = 0;
};

TEST_F(PerceptionNodeTest, WaitsForTheSecondPoseAndInterpolates) {
  send_pose(kStart_us, 1.0, 0ms);
  send_cloud(kStart_us + 25'000, 10ms);
  EXPECT_TRUE(step(10ms).empty());
  send_pose(kStart_us + 100'000, 2.0, 90ms);
  const auto frames = step(90ms);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_NEAR(frames[0].evidence.T_world_body.translation().x(), 1.25, 1e-9);
  EXPECT_EQ(frames[0].evidence.utime_us, kStart_us + 25'000);
  EXPECT_EQ(frames[0].source.cloud_source, "kinect");
  EXPECT_EQ(frames[0].source.frame, 1);
  ASSERT_FALSE(frames[0].evidence.surfels.empty());
  EXPECT_NEAR(frames[0].evidence.surfels[0].centroid_m.z(), 0.0, 0.005);
  EXPECT_GT(frames[0].evidence.surfels[0].centroid_m.x(), 1.25);
}

TEST_F(PerceptionNodeTest, DropsAndCountsACloudThatGetsNoPose) {
  send_cloud(kStart_us, 0ms);
  EXPECT_TRUE(step(100ms).empty());
  EXPECT_EQ(dropped("KINECT_CLOUD no body pose around its time"), 0);
  EXPECT_TRUE(step(101ms).empty());
  EXPECT_EQ(dropped("KINECT_CLOUD no body pose around its time"), 1);
  EXPECT_EQ(state_, health_t::DEGRADED);
  send_pose(kStart_us - 1000, 0.0, 110ms);
  send_pose(kStart_us + 1000, 0.0, 110ms);
  EXPECT_TRUE(step(110ms).empty());
}

TEST_F(PerceptionNodeTest, EveryWaitingCloudIsProcessedWhenItsPoseComesInTime) {
  send_pose(kStart_us, 0.0, 0ms);
  for (int i = 1; i <= 3; ++i) send_cloud(kStart_us + 30'000 * i, Micros(30'000 * i));
  EXPECT_TRUE(step(90ms).empty());
  send_pose(kStart_us + 100'000, 0.0, 100ms);
  EXPECT_EQ(step(100ms).size(), 3U);
  dropped("");
  EXPECT_EQ(state_, health_t::OK);
}

TEST_F(PerceptionNodeTest, ACloudThatANewerOneHasOvertakenIsDroppedAndCounted) {
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us + 500'000, 0.0, 0ms);
  for (int i = 1; i <= 3; ++i) send_cloud(kStart_us + 100'000 * i, Micros(100'000 * i));
  const auto frames = step(320ms);  // the node was busy with something else for so long
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].source.frame, 3);
  EXPECT_EQ(dropped("KINECT_CLOUD overtaken"), 2);
}

TEST_F(PerceptionNodeTest, AnAbsurdUtimeIsDroppedAtOnce) {
  send_pose(kStart_us, 0.0, 0ms);
  send_cloud(kStart_us + 3'600'000'000, 1ms);
  send_cloud(0, 2ms);
  EXPECT_TRUE(step(2ms).empty());
  EXPECT_EQ(dropped("KINECT_CLOUD absurd utime"), 2);
}

TEST_F(PerceptionNodeTest, AClockThatStepsBackStartsThePosesAnew) {
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us - 3'600'000'000, 0.0, 10ms);
  send_pose(kStart_us - 3'600'000'000 + 50'000, 0.0, 60ms);
  EXPECT_EQ(dropped("pose stream interrupted"), 1);
  send_cloud(kStart_us - 3'600'000'000 + 20'000, 61ms);
  EXPECT_EQ(step(61ms).size(), 1U);
}

TEST_F(PerceptionNodeTest, PosesFarApartAreNotInterpolated) {
  send_pose(kStart_us, 0.0, 0ms);
  send_cloud(kStart_us + 5'000'000, 1ms);
  send_pose(kStart_us + 9'000'000, 100.0, 2ms);
  EXPECT_TRUE(step(2ms).empty());
}

TEST_F(PerceptionNodeTest, CorruptCloudsAreDroppedWithTheirCause) {
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us + 100'000, 0.0, 0ms);
  for (const int damage : {0, 1, 2, 3, 4}) {
    depth_cloud_t m = cloud(kStart_us + 1000 * (damage + 1), ++frame_);
    if (damage == 0) m.fx = std::numeric_limits<float>::quiet_NaN();
    if (damage == 1) m.baseline = 0.0F;
    if (damage == 2) m.scale = -1.0F;
    if (damage == 3) m.sensor_orientation[0] = 5.0;
    if (damage == 4) {
      m.data.resize(m.data.size() / 2);
      m.size = static_cast<std::int32_t>(m.data.size());
    }
    deliver(channel::kKinectCloud, m, 1ms);
    EXPECT_TRUE(step(1ms).empty());
    EXPECT_EQ(dropped("KINECT_CLOUD corrupt"), damage + 1);
    EXPECT_EQ(state_, health_t::DEGRADED);
  }
  send_cloud(kStart_us + 50'000, 2ms);
  EXPECT_EQ(step(2ms).size(), 1U);
  dropped("");
  EXPECT_EQ(state_, health_t::OK);
}

TEST_F(PerceptionNodeTest, APoseWithoutSenseIsMalformed) {
  pose_t m{};
  m.utime = kStart_us;
  deliver(channel::kPose, m, 0ms);  // quaternion 0
  m.orientation[0] = 1.0;
  m.pos[2] = std::numeric_limits<double>::infinity();
  deliver(channel::kPose, m, 0ms);
  m.pos[2] = 1e9;
  deliver(channel::kPose, m, 0ms);
  EXPECT_EQ(inbox_.counts()[channel::kPose].malformed, 3);
}

TEST_F(PerceptionNodeTest, StripsOfAFrameGiveTheWholeFramesEvidence) {
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us + 100'000, 0.0, 0ms);
  deliver(channel::kKinectCloud, cloud(kStart_us + 1000, 1), 1ms);
  const auto whole = step(1ms);
  for (int row = 0; row < 120; row += 40)
    deliver(channel::kKinectCloud, cloud(kStart_us + 1000, 2, row, 40), 2ms);
  const auto strips = step(2ms);
  ASSERT_EQ(whole.size(), 1U);
  ASSERT_EQ(strips.size(), 1U);
  EXPECT_EQ(whole[0].evidence.cells.size(), strips[0].evidence.cells.size());
  for (std::size_t s = 0; s < 12; ++s)
    EXPECT_EQ(whole[0].evidence.sections[s].points, strips[0].evidence.sections[s].points);
}

TEST_F(PerceptionNodeTest, AFrameWithAMissingStripIsDroppedAndTheNextOneTaken) {
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us + 100'000, 0.0, 0ms);
  deliver(channel::kKinectCloud, cloud(kStart_us + 1000, 1, 0, 40), 1ms);
  deliver(channel::kKinectCloud, cloud(kStart_us + 1000, 1, 80, 40), 1ms);
  deliver(channel::kKinectCloud, cloud(kStart_us + 2000, 2), 1ms);
  const auto frames = step(1ms);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].source.frame, 2);
  EXPECT_EQ(dropped("KINECT_CLOUD incomplete"), 2);
}

/// All parts of one frame with a budget.
std::vector<surfels_t> parts_of_frame(PerceptionNode& node, Outbox& out, Budget& budget, Micros now) {
  while (node.step(now, budget, out)) {
  }
  std::vector<surfels_t> parts;
  for (const EncodedMessage& message : out.take())
    EXPECT_GT(parts.emplace_back().decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size())),
              0);
  return parts;
}

TEST_F(PerceptionNodeTest, ABudgetOfWorkSkipsSectionsTheSameWayEachTime) {
  PerceptionSettings settings;
  settings.time.compromise = "never";
  std::vector<std::vector<std::int8_t>> states;
  for (int repeat = 0; repeat < 2; ++repeat) {
    PerceptionNode node(settings, {}, serial_);
    Inbox inbox;
    node.subscribe(inbox);
    inbox_ = std::move(inbox);
    send_pose(kStart_us, 0.0, 0ms);
    send_pose(kStart_us + 100'000, 0.0, 0ms);
    auto& state = states.emplace_back();
    for (int frame = 1; frame <= 3; ++frame) {
      send_cloud(kStart_us + 1000 * frame, 1ms);
      WorkBudget budget(1'300'000);
      const auto parts = parts_of_frame(node, out_, budget, 1ms);
      ASSERT_FALSE(parts.empty());
      for (const section_t& section : parts.back().sections) state.push_back(section.state);
    }
    EXPECT_EQ(state[1], section_t::DONE);      // straight ahead, nearest
    EXPECT_EQ(state[10], section_t::SKIPPED);  // farthest
  }
  EXPECT_EQ(states[0], states[1]);
}

TEST_F(PerceptionNodeTest, TheNearestRowLeavesBeforeTheOthersAreDone) {
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us + 100'000, 0.0, 0ms);
  send_cloud(kStart_us + 1000, 1ms);
  std::size_t first_to_leave = 0;
  out_.set_hurry([&] { first_to_leave = out_.take().size(); });
  UnlimitedBudget budget;
  const auto rest = parts_of_frame(node_, out_, budget, 1ms);
  EXPECT_GE(first_to_leave, 1U);
  ASSERT_GE(rest.size(), 1U);
  EXPECT_EQ(rest.front().part, static_cast<int>(first_to_leave));
  EXPECT_EQ(rest.back().parts, static_cast<int>(first_to_leave + rest.size()));
}

TEST_F(PerceptionNodeTest, AutomaticallyGivesUpWhatTheDeadlineAsksForAndSaysWhat) {
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us + 100'000, 0.0, 0ms);
  int skipped = 0;
  for (int frame = 1; frame <= 3; ++frame) {
    send_cloud(kStart_us + 1000 * frame, 1ms);
    WorkBudget budget(1'300'000);
    const auto parts = parts_of_frame(node_, out_, budget, 1ms);
    skipped = 0;
    for (const section_t& section : parts.back().sections)
      skipped += section.state == section_t::SKIPPED ? 1 : 0;
  }
  EXPECT_EQ(skipped, 0);  // the first frame had to skip some; then less is done of everything
  EXPECT_EQ(dropped("frames in time by " + Compromise::at(4).text()), 2);
  EXPECT_GT(dropped("sections skipped for time"), 0);
}

/// Kinect and Bumblebee frames that interleave give what each gives alone.
TEST_F(PerceptionNodeTest, TwoSensorsDoNotDisturbEachOther) {
  const auto told = [&](bool kinect, bool bumblebee) {
    PerceptionNode node({}, {}, serial_);
    Inbox inbox;
    node.subscribe(inbox);
    inbox_ = std::move(inbox);
    Outbox out({"perception", 3});
    send_pose(kStart_us, 0.0, 0ms);
    send_pose(kStart_us + 100'000, 0.1, 0ms);
    std::map<std::int8_t, std::vector<std::uint8_t>> bytes;  // by sensor
    for (int frame = 1; frame <= 3; ++frame)
      for (const bool is_kinect : {true, false}) {
        if (is_kinect ? !kinect : !bumblebee) continue;
        depth_cloud_t message = cloud(kStart_us + 10'000 * frame + (is_kinect ? 0 : 3000), frame);
        message.disparity_sigma = is_kinect ? 0.067F : 0.2F;
        message.sensor = is_kinect ? depth_cloud_t::KINECT : depth_cloud_t::BUMBLEBEE;
        message.seq = frame;
        deliver(is_kinect ? channel::kKinectCloud : channel::kBumblebeeCloud, message, 1ms);
        UnlimitedBudget budget;
        for (surfels_t& part : parts_of_frame(node, out, budget, 1ms)) {
          part.seq = 0;
          std::vector<std::uint8_t> encoded(static_cast<std::size_t>(part.getEncodedSize()));
          part.encode(encoded.data(), 0, static_cast<int>(encoded.size()));
          auto& all = bytes[part.sensor];
          all.insert(all.end(), encoded.begin(), encoded.end());
        }
      }
    return bytes;
  };
  const auto both = told(true, true);
  const auto kinect = told(true, false), bumblebee = told(false, true);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both.at(depth_cloud_t::KINECT), kinect.at(depth_cloud_t::KINECT));
  EXPECT_EQ(both.at(depth_cloud_t::BUMBLEBEE), bumblebee.at(depth_cloud_t::BUMBLEBEE));
  EXPECT_NE(kinect.at(depth_cloud_t::KINECT), bumblebee.at(depth_cloud_t::BUMBLEBEE));  // an error model each
}

/// Past its deadline a frame gives way to a newer one.
TEST_F(PerceptionNodeTest, ANewerFrameSupersedesOneThatIsTooLate) {
  class Late final : public Budget {
   public:
    void begin(Micros arrived, Micros) override { left_ = arrived < Micros(2ms) ? 0 : 1'000'000'000; }
    bool spend(std::int64_t, std::int64_t) override { return true; }
    void charge(std::int64_t) override {}
    [[nodiscard]] std::int64_t left_ns() const override { return left_; }

   private:
    std::int64_t left_ = 0;
  };
  send_pose(kStart_us, 0.0, 0ms);
  send_pose(kStart_us + 100'000, 0.0, 0ms);
  send_cloud(kStart_us + 1000, 1ms);
  send_cloud(kStart_us + 2000, 3ms);
  Late budget;
  const auto parts = parts_of_frame(node_, out_, budget, 4ms);
  for (const surfels_t& part : parts) EXPECT_EQ(part.frame, 2);
  EXPECT_EQ(dropped("KINECT_CLOUD overtaken"), 1);
}

}  // namespace
}  // namespace floornav
