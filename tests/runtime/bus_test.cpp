#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floornav/pose_t.hpp"
#include "runtime/process/lcm_transport.hpp"
#include "runtime/process/mailbox.hpp"
#include "runtime/process/message_header.hpp"
#include "tests/runtime/toy_nodes.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

const auto kNow = std::chrono::steady_clock::time_point{};  // a deadline that is over: take what is there

std::vector<std::string> contents(Mailbox& mailbox) {
  std::vector<std::string> all;
  for (const Mail& mail : mailbox.take(kNow))
    all.push_back(mail.channel + ":" + std::string(mail.bytes.begin(), mail.bytes.end()) + "-" +
                  std::to_string(mail.superseded));
  return all;
}

void put(Mailbox& mailbox, const std::string& channel, const std::string& text) {
  mailbox.put(channel, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(Mailbox, KeepsTheLatestOrAllInOrderOfArrival) {
  Mailbox mailbox;
  mailbox.open("CLOUD", Keep::kLatest);
  mailbox.open("POSE", Keep::kAll);
  put(mailbox, "CLOUD", "c1");
  put(mailbox, "POSE", "p1");
  put(mailbox, "OTHER", "x");
  put(mailbox, "CLOUD", "c2");
  put(mailbox, "POSE", "p2");
  EXPECT_THAT(contents(mailbox), testing::ElementsAre("POSE:p1-0", "CLOUD:c2-1", "POSE:p2-0"));
  EXPECT_THAT(contents(mailbox), testing::IsEmpty());
}

TEST(Mailbox, KeepsTheLatestOfEachSource) {
  Mailbox mailbox;
  mailbox.open("GOAL", Keep::kLatest);
  for (int i = 1; i <= 10; ++i) {
    for (const char* source : {"a", "b"}) {
      goal_t goal = goal_of(1, i);
      goal.source = source;
      mailbox.put("GOAL", encoded("GOAL", goal).bytes);
    }
  }
  const auto mail = mailbox.take(kNow);
  ASSERT_EQ(mail.size(), 2U);
  EXPECT_EQ(mail[0].superseded + mail[1].superseded, 18);
  EXPECT_EQ(peek_header(mail[0].bytes)->source, "a");
  EXPECT_EQ(peek_header(mail[0].bytes)->seq, 10);
}

TEST(Mailbox, HoldsABoundedAmountOfWhateverIsSent) {
  Mailbox mailbox;
  mailbox.open("POSE", Keep::kAll);
  mailbox.open("BIG", Keep::kAll);
  mailbox.open("GOAL", Keep::kLatest);
  for (int i = 0; i < 3000; ++i) put(mailbox, "POSE", std::to_string(i));
  for (int i = 0; i < 10; ++i) put(mailbox, "BIG", std::string(20 << 20, 'x'));
  for (int i = 0; i < 1000; ++i) {
    goal_t goal = goal_of(1, 1);
    goal.source = "source" + std::to_string(i);
    mailbox.put("GOAL", encoded("GOAL", goal).bytes);
  }
  std::map<std::string, std::int64_t> messages;
  std::map<std::string, std::int64_t> superseded;
  std::string last_pose;
  for (const Mail& mail : mailbox.take(kNow)) {
    ++messages[mail.channel];
    superseded[mail.channel] += mail.superseded;
    if (mail.channel == "POSE") last_pose.assign(mail.bytes.begin(), mail.bytes.end());
  }
  EXPECT_EQ(messages["POSE"], 1000);
  EXPECT_EQ(superseded["POSE"], 2000);
  EXPECT_EQ(last_pose, "2999");
  EXPECT_EQ(messages["BIG"], 3);
  EXPECT_LE(messages["GOAL"], 17);
  EXPECT_EQ(messages["GOAL"] + superseded["GOAL"], 1000);
}

TEST(MessageHeader, IsReadWithoutTheRest) {
  goal_t goal = goal_of(-5, 77);
  goal.utime = 123456789;
  const auto bytes = encoded("X", goal).bytes;
  const auto header = peek_header(bytes);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->utime, 123456789);
  EXPECT_EQ(header->source, "sender");
  EXPECT_EQ(header->session, -5);
  EXPECT_EQ(header->seq, 77);
  EXPECT_EQ(peek_utime(bytes), 123456789);
  pose_t pose{};
  pose.utime = 42;
  pose.pos[0] = -1.5;
  EXPECT_EQ(peek_utime(encoded("POSE", pose).bytes), 42);
  EXPECT_FALSE(peek_header(encoded("POSE", pose).bytes));
}

TEST(MessageHeader, ReadsNothingBeyondTheBytes) {
  const auto whole = encoded("X", goal_of(1, 1)).bytes;
  const std::size_t header_bytes = 8 + 8 + 4 + 7 + 16;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::uint8_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(peek_header(cut).has_value(), size >= header_bytes) << size;
  }
  std::mt19937 random(1);
  for (int i = 0; i < 10'000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 64);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? random() : 0);
    const auto header = peek_header(bytes);
    EXPECT_LE(header ? header->source.size() + 36 : 0, bytes.size());
  }
}

TEST(LcmTransport, CarriesMessagesWithinAProcess) {
  LcmTransport bus("memq://");
  bus.subscribe("A");
  std::vector<std::string> got;
  const Transport::Receiver receiver = [&](std::string_view channel, std::span<const std::uint8_t> bytes) {
    got.push_back(std::string(channel) + std::to_string(bytes.size()));
  };
  bus.receive(0ms, receiver);
  EXPECT_TRUE(bus.publish({"A", std::vector<std::uint8_t>(10)}));
  EXPECT_TRUE(bus.publish({"B", {}}));
  EXPECT_TRUE(bus.publish({"A", std::vector<std::uint8_t>(100'000)}));
  bus.receive(1000ms, receiver);
  EXPECT_THAT(got, testing::ElementsAre("A10", "A100000"));
}

class BadUrl : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(BadUrl, IsRefusedInOneLine) {
  try {
    const LcmTransport bus(GetParam().first);
    FAIL() << "taken";
  } catch (const TransportError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr(GetParam().second));
    EXPECT_THAT(e.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadUrl,
                         testing::Values(std::pair{"239.255.76.67:7667", "is not an LCM URL"},
                                         std::pair{"http://x", "is not an LCM URL"},
                                         std::pair{"udpm://10.0.0.1:7667", "not a multicast address"},
                                         std::pair{"udpm://robot:7667", "not a multicast address"},
                                         std::pair{"udpm://239.255.76.67:0", "port"},
                                         std::pair{"udpm://239.255.76.67:76x", "port"},
                                         std::pair{"udpm://239.255.76.67:99999?ttl=0", "port"}));

TEST(LcmUrl, IsTheGivenOneOrTheEnvironmentsOrTheDefault) {
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(lcm_url("tcpq://a:1"), "tcpq://a:1");
  EXPECT_EQ(lcm_url(""), "memq://");
  unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(lcm_url(""), kDefaultLcmUrl);
}

}  // namespace
}  // namespace floornav
