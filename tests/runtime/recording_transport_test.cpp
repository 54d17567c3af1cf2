#include "runtime/process/recording_transport.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "runtime/process/log_reader.hpp"
#include "tests/runtime/temporary_file.hpp"

namespace floornav {
namespace {

class CountingBus final : public Transport {
 public:
  void subscribe(const std::string&) override {}
  bool publish(const EncodedMessage&) override {
    ++published;
    return works;
  }
  void receive(std::chrono::milliseconds, const Receiver&) override {}
  int published = 0;
  bool works = true;
};

EncodedMessage message(const std::string& channel, std::size_t size) {
  EncodedMessage m;
  m.channel = channel;
  m.bytes.assign(size, 7);
  return m;
}

TEST(RecordingTransport, WritesWhatItPublishes) {
  const TemporaryFile file("");
  CountingBus bus;
  std::vector<std::string> told;
  {
    RecordingTransport transport(bus, file.path(), [&](const std::string& line) { told.push_back(line); });
    EXPECT_TRUE(transport.publish(message("A", 10)));
    bus.works = false;
    EXPECT_FALSE(transport.publish(message("B", 200'000)));
  }
  EXPECT_EQ(bus.published, 2);
  EXPECT_TRUE(told.empty());
  LogReader reader(file.path());
  LogEvent event;
  ASSERT_TRUE(reader.next(event));
  EXPECT_EQ(event.channel, "A");
  EXPECT_EQ(event.bytes, std::vector<std::uint8_t>(10, 7));
  ASSERT_TRUE(reader.next(event));
  EXPECT_EQ(event.channel, "B");
  EXPECT_EQ(event.bytes.size(), 200'000U);
  EXPECT_FALSE(reader.next(event));
}

TEST(RecordingTransport, AFullDiskEndsTheRecordingAndNothingElse) {
  CountingBus bus;
  std::vector<std::string> told;
  RecordingTransport transport(bus, "/dev/full", [&](const std::string& line) { told.push_back(line); });
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(transport.publish(message("A", 100'000)));
  EXPECT_EQ(bus.published, 20);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("the recording ends"), std::string::npos) << told[0];
}

TEST(RecordingTransport, AFileThatCannotBeMadeIsAnError) {
  CountingBus bus;
  EXPECT_THROW(RecordingTransport(bus, "/nowhere/at/all.lcm", [](const std::string&) {}), LogError);
}

}  // namespace
}  // namespace floornav
