#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/process/inbox.hpp"

namespace floornav {

/// A message that waits for the node.
struct Mail {
  std::string channel;
  std::vector<std::uint8_t> bytes;
  std::chrono::steady_clock::time_point arrived;
  std::int64_t superseded = 0;  ///< older ones of the channel that it replaced
};

/// Between the bus thread, which puts, and the worker, which takes. Holds a bounded amount whatever is sent.
class Mailbox {
 public:
  /// Of kAll channels; what is older is dropped and counted as superseded.
  static constexpr std::size_t kMaxMessages = 1000;
  static constexpr std::size_t kMaxBytes = 64 << 20;
  /// Senders on one kLatest channel of which each has its own newest message.
  static constexpr std::size_t kMaxSources = 16;

  /// Before the first put().
  void open(const std::string& channel, Keep keep);

  /// A channel that is not open is ignored.
  void put(std::string_view channel, std::span<const std::uint8_t> bytes);

  /// Ends the wait of the current or the next take().
  void wake();

  /// All that is there, in the order of arrival. Waits for something until `deadline`.
  std::vector<Mail> take(std::chrono::steady_clock::time_point deadline);

 private:
  struct Held {
    std::uint64_t order = 0;
    Mail mail;
  };
  struct Slot {
    Keep keep = Keep::kLatest;
    std::deque<Held> held;                            ///< kAll
    std::size_t bytes = 0;                            ///< in held
    std::map<std::string, Held, std::less<>> latest;  ///< kLatest, by source
    std::int64_t superseded = 0;                      ///< told with the next message
  };
  void put_latest(Slot& slot, Held held);
  void put_all(Slot& slot, Held held);

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::string, Slot, std::less<>> slots_;
  std::uint64_t order_ = 0;
  std::size_t waiting_ = 0;  ///< messages
  bool woken_ = false;
};

}  // namespace floornav
