#include "runtime/process/live_executor.hpp"

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floornav/health_t.hpp"
#include "floornav/pose_t.hpp"
#include "tests/runtime/hub_transport.hpp"
#include "tests/runtime/toy_nodes.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

/// Runs a node on the hub until it goes out of scope.
class Running {
 public:
  Running(Hub& hub, Node& node, LiveOptions options = {})
      : transport_(hub),
        executor_(node, transport_, std::move(options)),
        thread_([this] { executor_.run(stop_); }) {
    transport_.wait_until_listening();
  }
  ~Running() { end(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  void end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::atomic<bool> stop_ = false;
  HubTransport transport_;
  LiveExecutor executor_;
  std::thread thread_;
};

class Live : public testing::Test {
 protected:
  bool answered(Listener<goal_t>& answers, std::int64_t id) {
    hub_.publish(encoded("IN", goal_of(1, ++seq_, id)));
    return answers.wait_for([&](const goal_t& g) { return g.id == id; });
  }
  Hub hub_;
  std::int64_t seq_ = 0;
};

std::int64_t drop(const health_t& health, const std::string& cause) {
  for (const drop_t& d : health.drops) {
    if (d.cause == cause) return d.count;
  }
  return 0;
}

TEST_F(Live, AnswersOverTheBusAndTellsItsHealth) {
  EchoNode node("echo", "IN", "OUT");
  Listener<goal_t> answers(hub_, "OUT");
  Listener<health_t> healths(hub_, "HEALTH");
  Running running(hub_, node, {.config_hash = 4711});
  ASSERT_TRUE(answered(answers, 7));
  ASSERT_TRUE(healths.wait_for([](const health_t& h) { return h.n_latencies == 2; }));
  const health_t& health = healths.all.back();
  EXPECT_EQ(health.source, "echo");
  EXPECT_EQ(health.state, health_t::OK);
  EXPECT_EQ(health.config_hash, 4711);
  EXPECT_NE(health.session, 0);
  EXPECT_EQ(health.session, answers.all.back().session);
  ASSERT_EQ(health.n_rates, 2);
  EXPECT_EQ(health.rates[0].channel, "IN");
  EXPECT_EQ(health.rates[0].count, 1);
  EXPECT_EQ(health.rates[1].channel, "OUT");
  EXPECT_EQ(health.rates[1].count, 1);
}

TEST_F(Live, TicksWithoutMessages) {
  struct Ticker : EchoNode {
    Ticker() : EchoNode("ticker", "IN", "OUT") { period = 10ms; }
    void tick(Micros, Outbox& out) override { out.publish("OUT", goal_t{}); }
  } node;
  Listener<goal_t> ticks(hub_, "OUT");
  const Running running(hub_, node);
  EXPECT_TRUE(ticks.wait_for([](const goal_t& g) { return g.seq >= 5; }));
}

TEST_F(Live, SaysItsLastWordWhenStopped) {
  struct Stopper : EchoNode {
    Stopper() : EchoNode("stopper", "IN", "OUT") {}
    void stop(Micros, Outbox& out) override {
      goal_t goal{};
      goal.command = goal_t::CANCEL;
      out.publish("OUT", goal);
    }
  } node;
  Listener<goal_t> answers(hub_, "OUT");
  Running running(hub_, node);
  ASSERT_TRUE(answered(answers, 1));
  running.end();
  EXPECT_TRUE(answers.wait_for([](const goal_t& g) { return g.command == goal_t::CANCEL; }));
}

TEST_F(Live, GoesOnAfterAnExceptionAndTellsIt) {
  struct Thrower : EchoNode {
    Thrower() : EchoNode("thrower", "IN", "OUT") {}
    bool step(Micros now, Budget& budget, Outbox& out) override {
      if (failures > 0 && failures-- > 0) throw std::runtime_error("a flaw");
      return EchoNode::step(now, budget, out);
    }
    std::atomic<int> failures = 1;
  } node;
  Listener<goal_t> answers(hub_, "OUT");
  Listener<health_t> healths(hub_, "HEALTH");
  const Running running(hub_, node);
  ASSERT_TRUE(healths.wait_for([](const health_t& h) { return h.state == health_t::DEGRADED; }));
  EXPECT_EQ(healths.all.back().reason, "step failed: a flaw");
  EXPECT_EQ(drop(healths.all.back(), "exceptions"), 1);
  EXPECT_TRUE(answered(answers, 3));
  node.failures = 1'000'000;
  EXPECT_TRUE(healths.wait_for([](const health_t& h) { return h.state == health_t::FAULT; }));
  node.failures = 0;
  EXPECT_TRUE(healths.wait_for([](const health_t& h) { return h.state == health_t::OK; }));
  EXPECT_TRUE(answered(answers, 4));
}

TEST_F(Live, DropsMalformedMessagesAndCountsThem) {
  EchoNode node("echo", "IN", "OUT");
  Listener<goal_t> answers(hub_, "OUT");
  Listener<health_t> healths(hub_, "HEALTH");
  const Running running(hub_, node);
  ASSERT_TRUE(answered(answers, 1));
  for (std::uint8_t i = 0; i < 100; ++i) hub_.publish({"IN", std::vector<std::uint8_t>(i, i)});
  EXPECT_TRUE(healths.wait_for([](const health_t& h) { return drop(h, "IN malformed") == 100; }));
  EXPECT_TRUE(answered(answers, 2));
}

TEST_F(Live, GivesABusyNodeOnlyTheNewestMessage) {
  struct Slow : EchoNode {
    Slow() : EchoNode("slow", "IN", "OUT", Keep::kLatest) {}
    bool step(Micros now, Budget& budget, Outbox& out) override {
      while (blocked) std::this_thread::sleep_for(1ms);
      return EchoNode::step(now, budget, out);
    }
    std::atomic<bool> blocked = false;
  } node;
  Listener<goal_t> answers(hub_, "OUT");
  Listener<health_t> healths(hub_, "HEALTH");
  const Running running(hub_, node);
  ASSERT_TRUE(answered(answers, 1));
  node.blocked = true;
  std::this_thread::sleep_for(100ms);  // the worker is held in step; what comes now waits
  for (int i = 0; i < 50; ++i) hub_.publish(encoded("IN", goal_of(1, ++seq_, 1000 + i)));
  std::this_thread::sleep_for(100ms);
  node.blocked = false;
  ASSERT_TRUE(answers.wait_for([](const goal_t& g) { return g.id == 1049; }));
  EXPECT_TRUE(healths.wait_for([](const health_t& h) { return drop(h, "IN superseded") >= 48; }));
  EXPECT_EQ(drop(healths.all.back(), "IN lost"), 0);
  EXPECT_LT(answers.all.size(), 10U);
}

TEST_F(Live, TellsOfAnotherPublisherOnItsChannel) {
  EchoNode node("echo", "IN", "OUT");
  Listener<goal_t> answers(hub_, "OUT");
  Listener<health_t> healths(hub_, "HEALTH");
  const Running running(hub_, node);
  ASSERT_TRUE(answered(answers, 1));
  ASSERT_TRUE(healths.wait_for([](const health_t& h) { return h.state == health_t::OK; }));
  goal_t rival = goal_of(99, 1);
  rival.source = "send\ner\x01";
  hub_.publish(encoded("OUT", rival));
  ASSERT_TRUE(healths.wait_for([](const health_t& h) { return h.state == health_t::DEGRADED; }));
  EXPECT_THAT(healths.all.back().reason, testing::HasSubstr("'send?er?' also publishes OUT"));
  EXPECT_TRUE(healths.wait_for([](const health_t& h) { return h.state == health_t::OK; }));
}

TEST_F(Live, SurvivesABusThatFails) {
  struct Broken final : Transport {
    void subscribe(const std::string&) override {}
    bool publish(const EncodedMessage& m) override {
      if (m.channel == "HEALTH") {
        health_t h;
        if (h.decode(m.bytes.data(), 0, static_cast<int>(m.bytes.size())) > 0 && drop(h, "bus errors") > 0)
          told = true;
      }
      return false;
    }
    void receive(std::chrono::milliseconds, const Receiver&) override { throw std::runtime_error("lost"); }
    std::atomic<bool> told = false;
  } transport;
  EchoNode node("echo", "IN", "OUT");
  LiveExecutor executor(node, transport, {});
  std::atomic<bool> stop = false;
  std::thread thread([&] { executor.run(stop); });
  for (int i = 0; i < 2000 && !transport.told; ++i) std::this_thread::sleep_for(10ms);
  EXPECT_TRUE(transport.told);
  stop = true;
  thread.join();
}

TEST_F(Live, FollowsTheTimeOfALog) {
  EchoNode node("echo", "IN", "OUT");
  node.period = 100us;
  Listener<goal_t> answers(hub_, "OUT");
  {
    const Running running(hub_, node, {.log_time = true});
    for (int seq = 1; seq <= 5; ++seq)
      hub_.publish(encoded("IN", goal_of(1, seq, seq)));  // utime = 1000 us x seq
    ASSERT_TRUE(answers.wait_for([](const goal_t& g) { return g.id == 5; }));
  }
  std::vector<std::string> begin(node.diary.begin(), node.diary.begin() + 3);
  EXPECT_THAT(begin, testing::ElementsAre("accept 1 @1000", "step 1 @1000", "tick @1100"));
  const auto fifth = std::find(node.diary.begin(), node.diary.end(), "accept 5 @5000");
  ASSERT_NE(fifth, node.diary.end());
  EXPECT_EQ(std::count_if(node.diary.begin(), fifth, [](const std::string& s) { return s[0] == 't'; }), 40);
}

TEST_F(Live, LetsLogTimeRunOnALittleAfterTheLogsEnd) {
  struct Waiting : EchoNode {
    Waiting() : EchoNode("waiting", "IN", "OUT") {}
    void tick(Micros now, Outbox& out) override {
      if (now > 500ms) out.publish("OUT", goal_t{});
    }
  } node;
  Listener<goal_t> answers(hub_, "OUT");
  const Running running(hub_, node, {.log_time = true});
  hub_.publish(encoded("IN", goal_of(1, 1, 1)));
  EXPECT_TRUE(answers.wait_for([](const goal_t& g) { return g.seq >= 2; }));
}

TEST_F(Live, TakesALogThatIsPlayedAgain) {
  EchoNode node("echo", "IN", "OUT");
  Listener<goal_t> answers(hub_, "OUT");
  const Running running(hub_, node, {.log_time = true});
  for (int round = 0; round < 3; ++round) {
    for (int seq = 1; seq <= 3; ++seq) {
      goal_t goal = goal_of(1, seq, seq);
      goal.utime = 2'000'000 * seq;
      hub_.publish(encoded("IN", goal));
    }
  }
  EXPECT_TRUE(answers.wait_for([](const goal_t& g) { return g.seq == 9; }));
}

}  // namespace
}  // namespace floornav
