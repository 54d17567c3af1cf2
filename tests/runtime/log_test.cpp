#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>

#include "runtime/process/log_reader.hpp"
#include "runtime/process/log_writer.hpp"
#include "tests/runtime/temporary_file.hpp"

namespace floornav {
namespace {

LogEvent event(int i, std::size_t bytes = 50) {
  LogEvent e{1'700'000'000'000'000 + 1000 * i, "CHANNEL_" + std::to_string(i), {}};
  e.bytes.assign(bytes, static_cast<std::uint8_t>(i));
  return e;
}

std::string log_of(const std::vector<LogEvent>& events) {
  const TemporaryFile file;
  LogWriter writer(file.path());
  for (const LogEvent& e : events) writer.write(e.timestamp_us, e.channel, e.bytes);
  writer.close();
  return file.content();
}

struct ReadBack {
  std::vector<std::string> channels;
  std::int64_t skipped_bytes = 0;
  std::int64_t skipped_places = 0;
};

ReadBack read(const std::string& content) {
  const TemporaryFile file(content);
  LogReader reader(file.path());
  ReadBack result;
  LogEvent e;
  while (reader.next(e)) result.channels.push_back(e.channel);
  result.skipped_bytes = reader.skipped_bytes();
  result.skipped_places = reader.skipped_places();
  return result;
}

TEST(LogWriter, WritesWhatLiblcmReads) {
  const TemporaryFile file(log_of({event(0), event(1, 0), event(2, 70'000)}));
  lcm::LogFile log(file.path(), "r");
  for (const LogEvent& expected : {event(0), event(1, 0), event(2, 70'000)}) {
    const lcm::LogEvent* got = log.readNextEvent();
    ASSERT_NE(got, nullptr);
    EXPECT_EQ(got->channel, expected.channel);
    EXPECT_EQ(got->timestamp, expected.timestamp_us);
    ASSERT_EQ(static_cast<std::size_t>(got->datalen), expected.bytes.size());
    EXPECT_TRUE(
        std::equal(expected.bytes.begin(), expected.bytes.end(), static_cast<std::uint8_t*>(got->data)));
  }
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST(LogReader, ReadsWhatLiblcmWrites) {
  const TemporaryFile file;
  {
    lcm::LogFile log(file.path(), "w");
    for (int i = 0; i < 3; ++i) {
      LogEvent e = event(i, 10);
      lcm::LogEvent raw{i, e.timestamp_us, e.channel, static_cast<std::int32_t>(e.bytes.size()),
                        e.bytes.data()};
      log.writeEvent(&raw);
    }
  }
  EXPECT_EQ(file.content(), log_of({event(0, 10), event(1, 10), event(2, 10)}));
  LogReader reader(file.path());
  LogEvent e;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(reader.next(e));
    EXPECT_EQ(e.channel, event(i).channel);
    EXPECT_EQ(e.timestamp_us, event(i).timestamp_us);
    EXPECT_EQ(e.bytes, event(i, 10).bytes);
  }
  EXPECT_FALSE(reader.next(e));
  EXPECT_EQ(reader.skipped_bytes(), 0);
  EXPECT_EQ(reader.skipped_places(), 0);
}

TEST(LogReader, ReadsEventsLargerThanItsWindow) {
  const ReadBack result = read(log_of({event(0, 5'000'000), event(1), event(2, 3'000'000), event(3)}));
  EXPECT_EQ(result.channels.size(), 4U);
  EXPECT_EQ(result.skipped_bytes, 0);
}

TEST(LogReader, ReadsALogCutShortUpToTheCut) {
  const std::string whole = log_of({event(0), event(1), event(2)});
  const std::size_t event_bytes = whole.size() / 3;
  for (std::size_t size = event_bytes; size < whole.size(); ++size) {
    const ReadBack result = read(whole.substr(0, size));
    EXPECT_EQ(result.channels.size(), size / event_bytes) << size;
    EXPECT_EQ(result.skipped_bytes, static_cast<std::int64_t>(size % event_bytes)) << size;
    EXPECT_EQ(result.skipped_places, size % event_bytes == 0 ? 0 : 1) << size;
  }
}

struct Damage {
  std::string name;
  std::size_t offset;  // from the beginning of the second event
  std::string bytes;
};

class LogReaderSurvives : public testing::TestWithParam<Damage> {};

TEST_P(LogReaderSurvives, AndLosesOnlyTheDamagedEvent) {
  std::string log = log_of({event(0), event(1), event(2), event(3)});
  log.replace(log.size() / 4 + GetParam().offset, GetParam().bytes.size(), GetParam().bytes);
  const ReadBack result = read(log);
  EXPECT_THAT(result.channels, testing::ElementsAre("CHANNEL_0", "CHANNEL_2", "CHANNEL_3"));
  EXPECT_EQ(result.skipped_bytes, static_cast<std::int64_t>(log.size() / 4));
  EXPECT_EQ(result.skipped_places, 1);
}

INSTANTIATE_TEST_SUITE_P(All, LogReaderSurvives,
                         testing::Values(Damage{"BrokenSync", 0, std::string(4, '\0')},
                                         Damage{"HugeData", 24, std::string("\x7f\xff\xff\xff", 4)},
                                         Damage{"NegativeData", 24, std::string("\xff\xff\xff\xff", 4)},
                                         Damage{"DataOverTheNextEvent", 24,
                                                std::string("\x00\x00\x00\x60", 4)},
                                         Damage{"HugeChannel", 20, std::string("\x7f\xff\xff\xff", 4)},
                                         Damage{"EmptyChannel", 20, std::string(4, '\0')},
                                         Damage{"ChannelOfBinary", 28, std::string("\x00\x01\x02", 3)},
                                         Damage{"ZeroedHeader", 0, std::string(28, '\0')}),
                         [](const auto& info) { return info.param.name; });

TEST(LogReader, GoesOnAfterGarbageBetweenEvents) {
  const std::string a = log_of({event(0)});
  const std::string b = log_of({event(1)});
  const ReadBack result = read("garbage" + a + std::string(3'000'000, 'x') + b + "\xED\xA1\xDA\x01 end");
  EXPECT_THAT(result.channels, testing::ElementsAre("CHANNEL_0", "CHANNEL_1"));
  EXPECT_EQ(result.skipped_places, 3);
  EXPECT_EQ(result.skipped_bytes, 7 + 3'000'000 + 8);
}

TEST(LogReader, KeepsAnEventWhoseFollowerIsDamaged) {
  const std::string a = log_of({event(0)});
  EXPECT_THAT(read(a + "xxxx" + log_of({event(1)})).channels, testing::ElementsAre("CHANNEL_0", "CHANNEL_1"));
}

TEST(LogReader, FindsASyncWordAcrossTheWindowsBorder) {
  const std::string a = log_of({event(0)});
  for (std::size_t shift = 0; shift < 8; ++shift) {
    const std::string garbage((1 << 20) - a.size() - shift, 'x');
    EXPECT_EQ(read(a + garbage + a).channels.size(), 2U) << shift;
  }
}

class LogReaderUnderDamage : public testing::TestWithParam<unsigned> {};

TEST_P(LogReaderUnderDamage, EndsAndAccountsForEveryByte) {
  std::mt19937 random(GetParam());
  std::vector<LogEvent> events;
  for (int i = 0; i < 20; ++i) events.push_back(event(i, random() % 200));
  std::string log = log_of(events);
  for (int i = 0; i < 30; ++i) log[random() % log.size()] = static_cast<char>(random());
  const TemporaryFile file(log);
  std::int64_t taken = 0;
  try {
    LogReader reader(file.path());
    LogEvent e;
    while (reader.next(e))
      taken += kLogHeaderBytes + static_cast<std::int64_t>(e.channel.size() + e.bytes.size());
    EXPECT_EQ(taken + reader.skipped_bytes(), static_cast<std::int64_t>(log.size()));
  } catch (const LogError&) {
    EXPECT_EQ(taken, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, LogReaderUnderDamage, testing::Range(0U, 50U));

TEST(LogReader, RefusesWhatIsNoLogInOneLine) {
  std::mt19937 random(1);
  std::string noise(100'000, '\0');
  for (char& c : noise) c = static_cast<char>(random());
  const std::string whole = log_of({event(0)});
  for (const std::string& content :
       {std::string(), std::string("hello"), noise, whole.substr(0, whole.size() - 1)}) {
    const TemporaryFile file(content);
    try {
      const LogReader reader(file.path());
      ADD_FAILURE() << "taken";
    } catch (const LogError& e) {
      EXPECT_THAT(e.what(), testing::StartsWith(file.path().string() + ": "));
      EXPECT_THAT(e.what(), testing::Not(testing::HasSubstr("\n")));
    }
  }
  EXPECT_THROW(LogReader("/nowhere/x.lcm"), LogError);
  EXPECT_THROW(LogReader("/tmp"), LogError);
}

TEST(LogWriter, TellsOfAFullDisk) {
  LogWriter writer("/dev/full");
  EXPECT_THROW(
      {
        for (int i = 0; i < 1000; ++i) writer.write(0, "A", std::vector<std::uint8_t>(1000));
      },
      LogError);
  LogWriter small("/dev/full");
  small.write(0, "A", {});
  EXPECT_THROW(small.close(), LogError);
  EXPECT_THROW(LogWriter("/nowhere/x.lcm"), LogError);
}

TEST(LogWriter, RefusesAChannelThatLcmWouldNotTake) {
  const TemporaryFile file;
  LogWriter writer(file.path());
  EXPECT_THROW(writer.write(0, "", {}), std::invalid_argument);
  EXPECT_THROW(writer.write(0, std::string(64, 'A'), {}), std::invalid_argument);
  writer.write(0, std::string(63, 'A'), {});
}

}  // namespace
}  // namespace floornav
