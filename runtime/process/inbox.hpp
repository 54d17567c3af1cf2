#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/process/time.hpp"

namespace floornav {

/// What a live executor keeps of a channel while the node works.
enum class Keep {
  kLatest,  ///< the newest message only
  kAll,     ///< every message, in order, up to a bound
};

/// What happened to the messages of one channel.
struct ChannelCounts {
  std::int64_t received = 0;
  std::int64_t malformed = 0;   ///< did not decode, or the handler refused it by an exception
  std::int64_t superseded = 0;  ///< a newer one came before the node had time
  std::int64_t old = 0;         ///< duplicate, or of an older session or seq
  std::int64_t lost = 0;        ///< gaps in seq
};

/// A node's subscriptions: decodes safely, checks session and seq where the type has them, counts, and lets no
/// exception out.
class Inbox {
 public:
  /// `handler` is the node's accept: cheap, stores. A std::exception that it throws counts the message as malformed.
  template <class Message>
  void subscribe(const std::string& channel, Keep keep, std::function<void(const Message&, Micros now)> handler);

  /// Hands one message to its handlers; a channel that nobody subscribed to is ignored.
  void deliver(std::string_view channel, std::span<const std::uint8_t> bytes, Micros now);

  /// Tells that `count` messages of the channel were replaced by newer ones before delivery.
  void count_superseded(std::string_view channel, std::int64_t count);

  [[nodiscard]] std::vector<std::pair<std::string, Keep>> channels() const;
  [[nodiscard]] std::map<std::string, ChannelCounts> counts() const;
};

}  // namespace floornav
