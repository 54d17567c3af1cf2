#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "runtime/process/log_writer.hpp"
#include "runtime/process/transport.hpp"

namespace floornav {

/// Writes what is published to an LCM log on its way to the bus. A disk that is full ends the recording and
/// nothing else.
class RecordingTransport final : public Transport {
 public:
  /// `bus` must outlive it. `tell` gets one line where the recording ends early. Throws LogError for a file
  /// that cannot be made.
  RecordingTransport(Transport& bus, const std::filesystem::path& log,
                     std::function<void(const std::string&)> tell);

  void subscribe(const std::string& channel) override { bus_.subscribe(channel); }
  bool publish(const EncodedMessage& message) override;
  void receive(std::chrono::milliseconds timeout, const Receiver& receiver) override {
    bus_.receive(timeout, receiver);
  }

 private:
  Transport& bus_;
  std::optional<LogWriter> log_;
  std::function<void(const std::string&)> tell_;
};

}  // namespace floornav
