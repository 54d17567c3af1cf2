#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/process/sequence.hpp"
#include "runtime/process/time.hpp"

namespace floornav {

/// What a live executor keeps of a channel while the node works.
enum class Keep {
  kLatest,  ///< the newest message only
  kAll,     ///< every message, in order, up to a bound
};

/// What happened to the messages of one channel.
struct ChannelCounts {
  std::int64_t received = 0;     ///< all that came, whatever became of them
  std::int64_t malformed = 0;    ///< did not decode, or the handler refused it by an exception
  std::int64_t superseded = 0;   ///< a newer one came before the node had time
  std::int64_t old = 0;          ///< duplicate, or of an older session or seq
  std::int64_t rival = 0;        ///< of a second session of a source whose first one is alive
  std::int64_t unconfirmed = 0;  ///< the first one of a new session, or far ahead of the others
  std::int64_t lost = 0;         ///< gaps in seq
};

/// A node's subscriptions: decodes safely, checks session and seq where the type has them, counts, and lets
/// no exception out.
class Inbox {
 public:
  /// `handler` is the node's accept: cheap, stores. A std::exception that it throws counts the message as
  /// malformed. One handler a channel; throws std::logic_error for a second one.
  template <class Message>
  void subscribe(const std::string& channel, Keep keep,
                 std::function<void(const Message&, Micros now)> handler) {
    auto message = std::make_shared<Message>();  // decoded into again and again: no allocation per message
    add(channel, keep, [message, handler = std::move(handler)](Entry& entry, Bytes bytes, Micros now) {
      if (!decode_whole(*message, bytes)) {
        ++entry.counts.malformed;
        return;
      }
      if constexpr (Sequenced<Message>) {
        if (!in_order(entry, message->source, message->session, message->seq, now)) return;
      }
      handler(*message, now);
    });
  }

  /// Hands one message to its handler; a channel that nobody subscribed to is ignored.
  void deliver(std::string_view channel, std::span<const std::uint8_t> bytes, Micros now);

  /// Tells that `count` messages of the channel were replaced by newer ones before delivery.
  void count_superseded(std::string_view channel, std::int64_t count);

  /// Forgets which sessions and seqs have come; the counts stay.
  void forget_order();

  [[nodiscard]] std::vector<std::pair<std::string, Keep>> channels() const;
  [[nodiscard]] std::map<std::string, ChannelCounts> counts() const;

 private:
  using Bytes = std::span<const std::uint8_t>;
  struct Entry {
    Keep keep = Keep::kLatest;
    std::function<void(Entry&, Bytes, Micros now)> accept;
    ChannelCounts counts;
    SequenceCheck sequence;
    std::int64_t known_gap = 0;  ///< superseded messages that the next gap in seq does not count as lost
  };

  /// The hardened decode bounds every count by the bytes left; a message must fill its bytes exactly.
  template <class Message>
  static bool decode_whole(Message& message, Bytes bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return false;
    const int size = static_cast<int>(bytes.size());
    return message.decode(bytes.data(), 0, size) == size;
  }
  static bool in_order(Entry& entry, const std::string& source, std::int64_t session, std::int64_t seq,
                       Micros now);
  void add(const std::string& channel, Keep keep, std::function<void(Entry&, Bytes, Micros)> accept);

  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace floornav
