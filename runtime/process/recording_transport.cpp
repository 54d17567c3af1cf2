#include "runtime/process/recording_transport.hpp"

#include <utility>

namespace floornav {

RecordingTransport::RecordingTransport(Transport& bus, const std::filesystem::path& log,
                                       std::function<void(const std::string&)> tell)
    : bus_(bus), log_(log), tell_(std::move(tell)) {}

bool RecordingTransport::publish(const EncodedMessage& message) {
  const bool sent = bus_.publish(message);
  if (!log_) return sent;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  try {
    log_->write(std::chrono::duration_cast<std::chrono::microseconds>(now).count(), message.channel,
                message.bytes);
  } catch (const LogError& e) {
    log_.reset();
    tell_(std::string("the recording ends: ") + e.what());
  }
  return sent;
}

}  // namespace floornav
