#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "runtime/process/latency.hpp"
#include "runtime/process/log_clock.hpp"
#include "runtime/process/log_event.hpp"
#include "runtime/process/node.hpp"

namespace floornav {

struct ReplayOptions {
  /// What a node may spend on a frame, in ns of estimated work.
  std::int64_t work_budget_ns = std::numeric_limits<std::int64_t>::max();
  /// Virtual time after the log's last event, so that what waits can time out.
  Micros run_on = std::chrono::seconds(1);
};

/// Processor time of one node, on the machine's clock: the only thing in a replay that differs from run to
/// run.
struct NodeTiming {
  std::chrono::nanoseconds accept{0};  ///< decoding and storing messages, in all
  std::chrono::nanoseconds step{0};
  std::chrono::nanoseconds tick{0};
  LatencyHistogram runs;  ///< from a message or tick to rest, where it published something
};

/// Runs nodes over a log in one process on the caller's thread: one event at a time, until no node has
/// anything left to do; between events the ticks that are due. Nothing is dropped. What a node publishes is
/// delivered to all of them at once, in the order of the nodes, exactly as encoded.
class ReplayExecutor {
 public:
  /// Called for every message that is published or injected.
  using Sink = std::function<void(const EncodedMessage& message, Micros now)>;

  /// The nodes must outlive it; they are stepped in this order.
  ReplayExecutor(const std::vector<Node*>& nodes, Sink sink, ReplayOptions options = {});

  /// Delivers a message that is not in the log, before the next event.
  void inject(EncodedMessage message);

  /// Advances virtual time to the event's time stamp and delivers it. The log's messages on a channel that a
  /// node publishes are left out. Throws what a node throws, and std::runtime_error for one that never comes
  /// to rest.
  void deliver(const LogEvent& event);

  /// Runs on after the last event.
  void finish();

  [[nodiscard]] Micros now() const { return clock_.now(); }
  /// Jumps of the log's time stamps.
  [[nodiscard]] std::int64_t clock_jumps() const { return clock_.jumps(); }
  /// Events left out since a node publishes on their channel.
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }
  /// Of the node at this place of the constructor's list.
  [[nodiscard]] std::map<std::string, ChannelCounts> counts(std::size_t node) const;
  [[nodiscard]] const NodeTiming& timing(std::size_t node) const { return seats_.at(node).timing; }

 private:
  struct Seat {
    Seat(Node& its_node, std::int64_t work_ns)
        : node(&its_node), out(fixed_identity(its_node.name())), budget(work_ns) {}
    Node* node;
    Inbox inbox;
    Outbox out;
    Micros next_tick{0};
    NodeTiming timing;
    WorkBudget budget;
    bool resting = true;
    bool published = false;            ///< since it rested
    std::chrono::nanoseconds busy{0};  ///< since it rested
  };
  void start(Micros now);
  void fire_ticks(Micros until);
  void settle(Micros now);
  bool step(Seat& seat, Micros now);
  bool publish(Seat& seat, Micros now);
  void hand_out(const EncodedMessage& message, Micros now);
  void hand_out(const std::string& channel, std::span<const std::uint8_t> bytes, Micros now);

  std::vector<Seat> seats_;
  Sink sink_;
  ReplayOptions options_;
  LogClock clock_;
  std::vector<EncodedMessage> injected_;
  std::int64_t left_out_ = 0;
};

}  // namespace floornav
