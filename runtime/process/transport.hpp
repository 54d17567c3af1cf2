#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/process/outbox.hpp"

namespace floornav {

/// Carries encoded messages between processes. publish() may be called while another thread is in receive().
class Transport {
 public:
  using Receiver = std::function<void(std::string_view channel, std::span<const std::uint8_t> bytes)>;

  virtual ~Transport() = default;
  /// Before the first receive().
  virtual void subscribe(const std::string& channel) = 0;
  /// False where the message could not be sent.
  virtual bool publish(const EncodedMessage& message) = 0;
  /// Waits for a message, then hands over all that are there; a process's own messages come back to it.
  /// Throws std::runtime_error where the connection is lost.
  virtual void receive(std::chrono::milliseconds timeout, const Receiver& receiver) = 0;
};

}  // namespace floornav
