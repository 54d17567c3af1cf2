#include "runtime/process/inbox.hpp"

#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "floornav/goal_t.hpp"
#include "floornav/grid_map_t.hpp"
#include "floornav/pose_t.hpp"
#include "runtime/process/outbox.hpp"

namespace floornav {
namespace {

using std::chrono::milliseconds;

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  return bytes;
}

std::vector<std::uint8_t> goal(const std::string& source, std::int64_t session, std::int64_t seq) {
  goal_t message{};
  message.source = source;
  message.session = session;
  message.seq = seq;
  return encoded(message);
}

class GoalInbox : public testing::Test {
 protected:
  GoalInbox() {
    inbox_.subscribe<goal_t>("GOAL", Keep::kAll,
                             [this](const goal_t& goal, Micros) { taken_.push_back(goal.seq); });
  }
  void deliver(const std::string& source, std::int64_t session, std::int64_t seq, Micros now = Micros(0)) {
    inbox_.deliver("GOAL", goal(source, session, seq), now);
  }
  ChannelCounts counts() const { return inbox_.counts().at("GOAL"); }

  Inbox inbox_;
  std::vector<std::int64_t> taken_;
};

TEST_F(GoalInbox, DropsDuplicatesAndOlderSeqsOfASession) {
  for (const std::int64_t seq : {5, 5, 4, 6}) deliver("a", 1, seq);
  EXPECT_EQ(taken_, (std::vector<std::int64_t>{5, 6}));
  EXPECT_EQ(counts().received, 4);
  EXPECT_EQ(counts().old, 2);
  EXPECT_EQ(counts().lost, 0);
}

TEST_F(GoalInbox, CountsGapsAsLost) {
  for (const std::int64_t seq : {10, 11, 15, 16, 18}) deliver("a", 1, seq);
  EXPECT_EQ(counts().lost, 4);
  EXPECT_EQ(taken_.size(), 5U);
}

TEST_F(GoalInbox, DoesNotCountSupersededMessagesAsLost) {
  deliver("a", 1, 1);
  inbox_.count_superseded("GOAL", 3);
  deliver("a", 1, 5);
  EXPECT_EQ(counts().superseded, 3);
  EXPECT_EQ(counts().received, 5);
  EXPECT_EQ(counts().lost, 0);
  deliver("a", 1, 7);
  EXPECT_EQ(counts().lost, 1);
}

TEST_F(GoalInbox, TellsSourcesApart) {
  deliver("a", 1, 100);
  deliver("b", 2, 1);
  deliver("a", 1, 101);
  deliver("b", 2, 2);
  EXPECT_EQ(taken_, (std::vector<std::int64_t>{100, 1, 101, 2}));
  EXPECT_EQ(counts().lost, 0);
}

TEST_F(GoalInbox, TakesARestartedSenderFromItsSecondMessageOnAndNotItsOldSession) {
  deliver("a", 1, 100, milliseconds(0));
  deliver("a", 2, 1, milliseconds(600));
  deliver("a", 2, 2, milliseconds(610));
  deliver("a", 1, 101, milliseconds(611));
  deliver("a", 1, 102, milliseconds(5000));
  deliver("a", 2, 3, milliseconds(5001));
  EXPECT_EQ(taken_, (std::vector<std::int64_t>{100, 2, 3}));
  EXPECT_EQ(counts().old, 2);
  EXPECT_EQ(counts().unconfirmed, 1);
}

TEST_F(GoalInbox, IsNotShutByOneMessageWithADamagedSessionOrSeq) {
  std::int64_t seq = 0;
  for (int i = 0; i < 10; ++i) deliver("a", 1, ++seq, milliseconds(100 * i));
  deliver("a", 1, std::int64_t{1} << 40, milliseconds(1000));
  deliver("a", 1, ++seq, milliseconds(1001));
  deliver("a", 77, 5, milliseconds(2000));  // after a silence
  for (int i = 0; i < 10; ++i) deliver("a", 1, ++seq, milliseconds(2001 + 100 * i));
  EXPECT_EQ(taken_.size(), 21U);
  EXPECT_EQ(counts().unconfirmed, 2);
  EXPECT_EQ(counts().old + counts().rival + counts().lost, 0);
}

TEST_F(GoalInbox, IsNotShutByADamagedFirstMessage) {
  deliver("a", 1, std::int64_t{1} << 40);
  for (int seq = 1; seq <= 5; ++seq) deliver("a", 1, seq);
  EXPECT_EQ(taken_.size(), 5U);
}

TEST_F(GoalInbox, JoinsLateAndAfterALongGap) {
  for (const std::int64_t seq : {50'000, 50'001, 50'002, 90'000, 90'001, 90'002}) deliver("a", 1, seq);
  EXPECT_EQ(taken_, (std::vector<std::int64_t>{50'001, 50'002, 90'001, 90'002}));
  EXPECT_EQ(counts().lost, 90'000 - 50'002);
}

TEST_F(GoalInbox, WaitsLongerForAnotherSessionOfASlowSender) {
  for (int i = 0; i < 10; ++i) {
    deliver("a", 1, 1 + i, milliseconds(1000 * i));
    deliver("a", 2, 1 + i, milliseconds(1000 * i + 700));
  }
  EXPECT_EQ(taken_.size(), 10U);
  EXPECT_EQ(counts().rival + counts().unconfirmed, 10);
}

TEST_F(GoalInbox, RefusesASecondSessionWhileTheFirstLives) {
  for (int i = 0; i < 20; ++i) {
    deliver("a", 1, 1 + i, milliseconds(100 * i));
    deliver("a", 2, 1 + i, milliseconds(100 * i + 50));
  }
  EXPECT_EQ(taken_.size(), 20U);
  EXPECT_EQ(counts().rival, 20);
}

TEST_F(GoalInbox, RefusesSessionZeroAndSeqZero) {
  deliver("a", 0, 1);
  deliver("a", 1, 0);
  deliver("a", 1, -5);
  EXPECT_TRUE(taken_.empty());
  EXPECT_EQ(counts().malformed, 3);
}

TEST_F(GoalInbox, SurvivesExtremeSeqs) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  for (const char* source : {"a", "b"}) {
    for (const std::int64_t seq : {std::int64_t{1}, kMax - 1, kMax, kMax}) deliver(source, 1, seq);
  }
  EXPECT_EQ(taken_, (std::vector<std::int64_t>{1, kMax, 1, kMax}));
  EXPECT_EQ(counts().lost, kMax);
}

TEST_F(GoalInbox, RemembersABoundedNumberOfSources) {
  for (int i = 0; i < 10'000; ++i) deliver("source" + std::to_string(i), 1, 1, milliseconds(i));
  EXPECT_EQ(counts().received, 10'000);
  EXPECT_EQ(counts().malformed, 0);
}

TEST_F(GoalInbox, CountsEveryTruncationAndTrailingByteAsMalformed) {
  const std::vector<std::uint8_t> whole = goal("a", 1, 1);
  for (std::size_t size = 0; size < whole.size(); ++size)
    inbox_.deliver("GOAL", std::span(whole).first(size), Micros(0));
  std::vector<std::uint8_t> longer = whole;
  longer.push_back(0);
  inbox_.deliver("GOAL", longer, Micros(0));
  EXPECT_TRUE(taken_.empty());
  EXPECT_EQ(counts().malformed, static_cast<std::int64_t>(whole.size()) + 1);
}

TEST_F(GoalInbox, IgnoresAChannelThatNobodySubscribedTo) {
  inbox_.deliver("OTHER", goal("a", 1, 1), Micros(0));
  inbox_.count_superseded("OTHER", 1);
  EXPECT_EQ(inbox_.counts().size(), 1U);
}

TEST(Inbox, CatchesAndCountsAHandlersException) {
  Inbox inbox;
  int calls = 0;
  inbox.subscribe<pose_t>("POSE", Keep::kAll, [&](const pose_t&, Micros) {
    ++calls;
    throw std::invalid_argument("no valid quaternion");
  });
  const auto bytes = encoded(pose_t{});
  inbox.deliver("POSE", bytes, Micros(0));
  inbox.deliver("POSE", bytes, Micros(0));
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(inbox.counts().at("POSE").malformed, 2);
}

TEST(Inbox, HandsOnTheTimeAndListsItsChannels) {
  Inbox inbox;
  Micros seen{0};
  inbox.subscribe<pose_t>("POSE", Keep::kAll, [&](const pose_t&, Micros now) { seen = now; });
  inbox.subscribe<goal_t>("GOAL", Keep::kLatest, [](const goal_t&, Micros) {});
  inbox.deliver("POSE", encoded(pose_t{}), Micros(42));
  EXPECT_EQ(seen, Micros(42));
  EXPECT_EQ(inbox.channels(),
            (std::vector<std::pair<std::string, Keep>>{{"GOAL", Keep::kLatest}, {"POSE", Keep::kAll}}));
  EXPECT_THROW(inbox.subscribe<pose_t>("POSE", Keep::kAll, nullptr), std::logic_error);
}

class InboxUnderRandomBytes : public testing::TestWithParam<unsigned> {};

TEST_P(InboxUnderRandomBytes, DropsThemAll) {
  std::mt19937 random(GetParam());
  Inbox inbox;
  int taken = 0;
  inbox.subscribe<grid_map_t>("GRID_MAP", Keep::kAll, [&](const grid_map_t&, Micros) { ++taken; });
  const auto fingerprint = encoded(grid_map_t{});
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 300);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (i % 2 == 0 && bytes.size() >= 8) std::copy_n(fingerprint.begin(), 8, bytes.begin());
    inbox.deliver("GRID_MAP", bytes, Micros(i));
  }
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(inbox.counts().at("GRID_MAP").malformed, 2000);
}

INSTANTIATE_TEST_SUITE_P(Seeds, InboxUnderRandomBytes, testing::Range(0U, 8U));

TEST(Outbox, NumbersEachChannelByItselfAndSignsItsMessages) {
  Outbox out(Identity{"planner", 77});
  Inbox inbox;
  std::vector<std::string> seen;
  const auto note = [&](const goal_t& g, Micros) {
    seen.push_back(g.source + "/" + std::to_string(g.session) + "/" + std::to_string(g.seq));
  };
  inbox.subscribe<goal_t>("A", Keep::kAll, note);
  inbox.subscribe<goal_t>("B", Keep::kAll, note);
  for (const char* channel : {"A", "A", "B"}) out.publish(channel, goal_t{});
  for (const EncodedMessage& message : out.take()) inbox.deliver(message.channel, message.bytes, Micros(0));
  EXPECT_EQ(seen, (std::vector<std::string>{"planner/77/1", "planner/77/2", "planner/77/1"}));
  EXPECT_TRUE(out.take().empty());
}

TEST(Outbox, PublishesAMessageThatBearsNoSource) {
  Outbox out(Identity{"simulate", 1});
  out.publish("POSE", pose_t{});
  EXPECT_EQ(out.take().size(), 1U);
}

}  // namespace
}  // namespace floornav
