#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floornav/health_t.hpp"
#include "runtime/process/budget.hpp"
#include "runtime/process/inbox.hpp"
#include "runtime/process/outbox.hpp"
#include "runtime/process/time.hpp"

namespace floornav {

/// One stage of the flow behind its messages. All calls come from one thread, one at a time: the executors
/// (live and replay) differ in who delivers messages and whose clock `now` is, and the node cannot tell.
class Node {
 public:
  virtual ~Node() = default;

  [[nodiscard]] virtual std::string name() const = 0;
  /// The channels that it publishes. In replay the log's own messages on them are left out; live, another
  /// publisher on them is told in HEALTH.
  [[nodiscard]] virtual std::vector<std::string> outputs() const = 0;
  /// Live: `wake` asks for a step at once, from any thread, where something other than a message has come (a
  /// camera's frame). Empty: there is nobody to wake any more.
  virtual void set_wake(std::function<void()> /*wake*/) {}
  /// Declares the inputs; their handlers only store.
  virtual void subscribe(Inbox& inbox) = 0;
  /// Does one piece of work, a few milliseconds at most. True: there is more to do. Called after messages and
  /// ticks, and again as long as it says so.
  virtual bool step(Micros now, Budget& budget, Outbox& out) = 0;
  /// Called every tick_period(): time-outs, periodic messages.
  virtual void tick(Micros now, Outbox& out) = 0;
  [[nodiscard]] virtual Micros tick_period() const { return std::chrono::milliseconds(100); }
  /// Live: how long after its arrival a frame may be worked on, for the Budget; nothing: to the end.
  [[nodiscard]] virtual std::optional<Micros> deadline() const { return std::nullopt; }
  /// The process ends: the last thing that it has to say.
  virtual void stop(Micros /*now*/, Outbox& /*out*/) {}
  /// Adds the node's own state, reason, latencies and drops.
  virtual void report(health_t& health) const = 0;
};

}  // namespace floornav
