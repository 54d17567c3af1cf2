#include "runtime/process/replay_executor.hpp"

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/runtime/toy_nodes.hpp"

namespace floornav {
namespace {

using testing::ElementsAre;

LogEvent event_at(std::int64_t utime, const EncodedMessage& message) {
  return {utime, message.channel, message.bytes};
}

LogEvent goal_event(std::int64_t utime, std::int64_t seq) {
  return event_at(utime, encoded("IN", goal_of(1, seq, 100 + seq)));
}

struct Published {
  std::vector<std::string> lines;
  ReplayExecutor::Sink sink() {
    return [this](const EncodedMessage& message, Micros now) {
      goal_t goal;
      EXPECT_GT(goal.decode(message.bytes.data(), 0, static_cast<int>(message.bytes.size())), 0);
      lines.push_back(message.channel + " " + std::to_string(goal.id) + " " + goal.source + " " +
                      std::to_string(goal.seq) + " @" + std::to_string(now.count()));
    };
  }
};

TEST(ReplayExecutor, RunsAChainOfNodesToRestBeforeTheNextEvent) {
  EchoNode second("second", "MIDDLE",
                  "END");  // listed first: the order of the list is not the order of the flow
  EchoNode first("first", "IN", "MIDDLE");
  Published published;
  ReplayExecutor executor({&second, &first}, published.sink());
  executor.deliver(goal_event(1'000'000, 1));
  executor.deliver(goal_event(1'000'500, 2));
  EXPECT_THAT(published.lines, ElementsAre("MIDDLE 101 first 1 @1000000", "END 101 second 1 @1000000",
                                           "MIDDLE 102 first 2 @1000500", "END 102 second 2 @1000500"));
  EXPECT_EQ(executor.timing(0).runs.count(), 2);
  EXPECT_GT(executor.timing(0).step.count(), 0);
}

TEST(ReplayExecutor, FiresTicksAtTheirVirtualTimesBetweenEvents) {
  EchoNode node("node", "IN", "OUT");
  node.period = Micros(300);
  EchoNode slow("slow", "NOTHING", "NONE");
  slow.period = Micros(450);
  Published published;
  ReplayExecutor executor({&node, &slow}, published.sink(), {.run_on = Micros(400)});
  executor.deliver(goal_event(1000, 1));
  executor.deliver(goal_event(1900, 2));
  executor.finish();
  EXPECT_THAT(node.diary, ElementsAre("accept 101 @1000", "step 101 @1000", "tick @1300", "tick @1600",
                                      "tick @1900", "accept 102 @1900", "step 102 @1900", "tick @2200"));
  EXPECT_THAT(slow.diary, ElementsAre("tick @1450", "tick @1900"));
}

TEST(ReplayExecutor, DeliversANodesMessageToItself) {
  struct Countdown : EchoNode {
    Countdown() : EchoNode("countdown", "LOOP", "LOOP") {}
    void subscribe(Inbox& inbox) override {
      inbox.subscribe<goal_t>("START", Keep::kAll, [this](const goal_t& g, Micros) { left = g.id; });
      inbox.subscribe<goal_t>("LOOP", Keep::kAll, [this](const goal_t& g, Micros) { left = g.id; });
    }
    bool step(Micros, Budget&, Outbox& out) override {
      if (left <= 0) return false;
      goal_t goal{};
      goal.id = left - 1;
      left = 0;
      out.publish("LOOP", goal);
      return false;
    }
    std::int64_t left = 0;
  } node;
  Published published;
  ReplayExecutor executor({&node}, published.sink());
  executor.deliver(event_at(5, encoded("START", goal_of(1, 1, 3))));
  EXPECT_EQ(published.lines.size(), 3U);
}

TEST(ReplayExecutor, InjectsMessagesBeforeTheFirstEvent) {
  EchoNode node("node", "IN", "OUT");
  Published published;
  ReplayExecutor executor({&node}, published.sink());
  executor.inject(encoded("IN", goal_of(9, 1, 7)));
  EXPECT_TRUE(published.lines.empty());
  executor.deliver(event_at(5000, encoded("OTHER", goal_of(1, 1))));
  EXPECT_THAT(published.lines, ElementsAre("IN 7 sender 1 @5000", "OUT 7 node 1 @5000"));
}

TEST(ReplayExecutor, LeavesOutTheLogsMessagesOnTheNodesOwnChannels) {
  EchoNode node("node", "IN", "OUT");
  EchoNode reader("reader", "OUT", "END");
  Published published;
  ReplayExecutor executor({&node, &reader}, published.sink());
  executor.deliver(event_at(1000, encoded("OUT", goal_of(5, 1, 55))));
  executor.deliver(goal_event(1001, 1));
  EXPECT_EQ(executor.left_out(), 1);
  EXPECT_THAT(published.lines, ElementsAre("OUT 101 node 1 @1001", "END 101 reader 1 @1001"));
}

TEST(ReplayExecutor, GivesEachFrameTheBudgetAskedFor) {
  EchoNode node("node", "IN", "OUT");
  node.work_ns = 1000;
  Published published;
  ReplayExecutor executor({&node}, published.sink(), {.work_budget_ns = 1000});
  for (int seq = 1; seq <= 3; ++seq) executor.deliver(goal_event(1000 + seq, seq));
  EXPECT_EQ(node.refused, 0);
  node.work_ns = 1001;
  executor.deliver(goal_event(1010, 5));
  EXPECT_EQ(node.refused, 1);
}

TEST(WorkBudget, RefusesWhatDoesNotFitIntoTheFrame) {
  WorkBudget counted(1000);
  Budget& budget = counted;
  EXPECT_TRUE(budget.spend(1'000'000));  // no frame has begun
  budget.begin(Micros(0));
  EXPECT_TRUE(budget.spend(600));
  EXPECT_FALSE(budget.spend(500));
  EXPECT_TRUE(budget.spend(400));
  EXPECT_FALSE(budget.spend(1));
  budget.begin(Micros(0));
  EXPECT_TRUE(budget.spend(1000));
}

TEST(DeadlineBudget, RefusesWhatWouldBeLate) {
  DeadlineBudget deadline(std::chrono::seconds(100));
  Budget& budget = deadline;
  EXPECT_TRUE(budget.spend(0));  // no frame has begun
  const auto now = std::chrono::duration_cast<Micros>(std::chrono::steady_clock::now().time_since_epoch());
  budget.begin(now);
  EXPECT_TRUE(budget.spend(1));
  EXPECT_FALSE(budget.spend(100'000'000'000));
  budget.begin(now - std::chrono::seconds(101));
  EXPECT_FALSE(budget.spend(0));
}

TEST(ReplayExecutor, CountsWhatItDrops) {
  EchoNode node("node", "IN", "OUT");
  ReplayExecutor executor({&node}, [](const EncodedMessage&, Micros) {});
  executor.deliver(goal_event(1000, 5));
  executor.deliver(goal_event(1001, 5));
  executor.deliver({1002, "IN", {1, 2, 3}});
  executor.deliver(goal_event(1003, 8));
  const ChannelCounts counts = executor.counts(0).at("IN");
  EXPECT_EQ(counts.received, 4);
  EXPECT_EQ(counts.old, 1);
  EXPECT_EQ(counts.malformed, 1);
  EXPECT_EQ(counts.lost, 2);
}

TEST(ReplayExecutor, PublishesTheSameBytesEveryTime) {
  const auto run = [] {
    EchoNode a("a", "IN", "MIDDLE");
    EchoNode b("b", "MIDDLE", "END");
    std::vector<std::uint8_t> all;
    ReplayExecutor executor({&a, &b}, [&](const EncodedMessage& m, Micros) {
      all.insert(all.end(), m.bytes.begin(), m.bytes.end());
    });
    for (int i = 1; i < 100; ++i) executor.deliver(goal_event(1000 * i, i));
    executor.finish();
    return all;
  };
  const auto bytes = run();
  EXPECT_GT(bytes.size(), 1000U);
  EXPECT_EQ(run(), bytes);
}

TEST(ReplayExecutor, SurvivesTimeStampsThatJump) {
  EchoNode node("node", "IN", "OUT");
  Published published;
  ReplayExecutor executor({&node}, published.sink());
  std::int64_t seq = 0;
  for (const std::int64_t stamp : {std::int64_t{1'000'000}, std::numeric_limits<std::int64_t>::max(),
                                   std::numeric_limits<std::int64_t>::min(), std::int64_t{1'000'100}})
    executor.deliver(goal_event(stamp, ++seq));
  executor.finish();
  EXPECT_EQ(published.lines.size(), 4U);
  EXPECT_EQ(executor.clock_jumps(), 3);
  EXPECT_EQ(executor.now(), Micros(1'000'000 + 1'000'000));
}

TEST(ReplayExecutor, EndsWithANodeThatNeverRests) {
  struct Restless : EchoNode {
    Restless() : EchoNode("restless", "IN", "OUT") {}
    bool step(Micros, Budget&, Outbox&) override { return true; }
  } node;
  ReplayExecutor executor({&node}, [](const EncodedMessage&, Micros) {});
  EXPECT_THROW(executor.deliver(goal_event(1, 1)), std::runtime_error);
}

TEST(ReplayExecutor, DoesNothingWithoutAnEvent) {
  EchoNode node("node", "IN", "OUT");
  ReplayExecutor executor({&node}, [](const EncodedMessage&, Micros) {});
  executor.finish();
  EXPECT_TRUE(node.diary.empty());
}

}  // namespace
}  // namespace floornav
