#pragma once

#include <string>

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
  /// Declares the inputs; their handlers only store.
  virtual void subscribe(Inbox& inbox) = 0;
  /// Does one piece of work, a few milliseconds at most. True: there is more to do.
  virtual bool step(Micros now, Budget& budget, Outbox& out) = 0;
  /// Called every tick_period(): time-outs, periodic messages.
  virtual void tick(Micros now, Outbox& out) = 0;
  [[nodiscard]] virtual Micros tick_period() const { return std::chrono::milliseconds(100); }
  /// Adds the node's own state, reason, latencies and drops.
  virtual void report(health_t& health) const = 0;
};

}  // namespace floornav
