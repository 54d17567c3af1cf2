#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "runtime/process/fault_log.hpp"
#include "runtime/process/latency.hpp"
#include "runtime/process/log_clock.hpp"
#include "runtime/process/mailbox.hpp"
#include "runtime/process/node.hpp"
#include "runtime/process/rival_watch.hpp"
#include "runtime/process/transport.hpp"

namespace floornav {

struct LiveOptions {
  /// Time is the newest utime that came, for a log that is played on a private bus. Then every message is
  /// kept and nothing has a deadline, so that the result is that of a replay as long as the machine keeps up.
  bool log_time = false;
  std::int64_t config_hash = 0;
  /// Called with one line for a person where the state changes.
  std::function<void(const std::string& line)> log = [](const std::string&) {};
};

/// Runs one node on a bus. A thread of its own empties the bus into a mailbox; the caller's thread hands the
/// mail to the node, steps it between messages, and publishes what it says. The node's exceptions are caught,
/// counted and told in HEALTH, which goes out once a second and when the state changes.
class LiveExecutor {
 public:
  /// Both must outlive it.
  LiveExecutor(Node& node, Transport& transport, LiveOptions options);

  /// Until `stop` is set; then the node says its last word. Returns within 100 ms unless the node works
  /// longer.
  void run(const std::atomic<bool>& stop);

 private:
  using Instant = std::chrono::steady_clock::time_point;

  void subscribe();
  void listen(const std::stop_token& stop);
  void turn();
  void hand_over(const Mail& mail);
  void fire_ticks(Instant now);
  void step();
  void run_on(Instant now, bool idle);
  void publish();
  bool guard(const char* doing, const std::function<void()>& work);
  [[nodiscard]] Micros node_time(Instant now) const;
  [[nodiscard]] Instant next_wake(Instant now) const;
  void tell_health(Instant now);
  [[nodiscard]] health_t health(Instant now);
  void add_rates(health_t& health, Instant now);

  Node& node_;
  Transport& transport_;
  LiveOptions options_;
  Identity identity_;
  Inbox inbox_;
  Outbox out_;
  Mailbox mailbox_;
  std::deque<Mail> mail_;  ///< taken, not yet handed over
  RivalWatch rivals_;
  FaultLog faults_;
  std::unique_ptr<Budget> budget_;
  std::atomic<std::int64_t> bus_errors_ = 0;

  LogClock log_clock_;
  Instant last_mail_{};
  Instant ran_on_{};  ///< until when log time has been let run on
  std::optional<Micros> next_tick_;

  bool resting_ = true;
  bool published_ = false;  ///< since it rested
  Instant run_began_{};     ///< arrival of the message, or time of the tick, that ended the rest
  std::chrono::nanoseconds busy_{0};
  RecentLatency steps_;      ///< work from rest to rest
  RecentLatency responses_;  ///< from arrival to the end of the work on it

  std::map<std::string, std::int64_t> sent_;
  std::map<std::string, std::int64_t> not_sent_;
  std::map<std::string, std::int64_t> counts_before_;  ///< at the last periodic HEALTH
  std::map<std::string, float> hz_;
  Instant last_health_{};
  Instant last_look_{};
  std::int8_t state_ = 0;
  std::string reason_;
};

}  // namespace floornav
