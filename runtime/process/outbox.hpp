#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/process/identity.hpp"
#include "runtime/process/sequence.hpp"

namespace floornav {

/// A message as it goes over the wire.
struct EncodedMessage {
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

/// What a node says during one call; the executor alone publishes it.
class Outbox {
 public:
  explicit Outbox(Identity identity) : identity_(std::move(identity)) {}

  /// Fills in source, session and the channel's next seq where the type has them, and queues the encoded
  /// message. Throws std::logic_error where a count differs from its vector's size.
  template <class Message>
  void publish(const std::string& channel, Message message) {
    if constexpr (Sequenced<Message>) {
      message.source = identity_.source;
      message.session = identity_.session;
      message.seq = ++last_seq_[channel];
    }
    EncodedMessage encoded{channel,
                           std::vector<std::uint8_t>(static_cast<std::size_t>(message.getEncodedSize()))};
    const int size = static_cast<int>(encoded.bytes.size());
    if (message.encode(encoded.bytes.data(), 0, size) != size)
      throw std::logic_error(channel + ": message does not encode: a count differs from its array");
    messages_.push_back(std::move(encoded));
  }

  /// Lets what was published so far leave at once, in the middle of a step, where the executor can do that.
  void hurry() {
    if (hurry_) hurry_();
  }
  void set_hurry(std::function<void()> hurry) { hurry_ = std::move(hurry); }

  /// What was published since the last call, in order.
  std::vector<EncodedMessage> take() { return std::exchange(messages_, {}); }

 private:
  Identity identity_;
  std::map<std::string, std::int64_t> last_seq_;
  std::vector<EncodedMessage> messages_;
  std::function<void()> hurry_;
};

}  // namespace floornav
