#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

#include "runtime/process/time.hpp"

namespace floornav {

/// What a node may still spend on the frame that it works on. Live it is a deadline on the monotonic clock;
/// in replay it is unlimited or counted in work, so that the same log gives the same result.
class Budget {
 public:
  virtual ~Budget() = default;
  /// A new frame begins, with a budget of its own; `arrived` is the `now` with which it was handed over.
  /// Before the first begin() nothing is limited.
  virtual void begin(Micros arrived) = 0;
  /// Asks for `work` nanoseconds' worth of work (as estimated, the same on every machine). False: leave it
  /// out.
  virtual bool spend(std::int64_t work_ns) = 0;
};

class UnlimitedBudget final : public Budget {
 public:
  void begin(Micros) override {}
  bool spend(std::int64_t) override { return true; }
};

/// Counts work: what exceeds the limit is refused, smaller work may still fit.
class WorkBudget final : public Budget {
 public:
  explicit WorkBudget(std::int64_t limit_ns) : limit_ns_(limit_ns) {}
  void begin(Micros) override { left_ns_ = limit_ns_; }
  bool spend(std::int64_t work_ns) override {
    if (work_ns > left_ns_) return false;
    left_ns_ -= work_ns;
    return true;
  }

 private:
  std::int64_t limit_ns_;
  std::int64_t left_ns_ = std::numeric_limits<std::int64_t>::max();
};

/// Refuses what would not be done within a time from a frame's arrival. Only for a `now` of the monotonic
/// clock.
class DeadlineBudget final : public Budget {
 public:
  explicit DeadlineBudget(Micros limit) : limit_(limit) {}
  void begin(Micros arrived) override { deadline_ = arrived + limit_; }
  bool spend(std::int64_t work_ns) override {
    const auto done = std::chrono::steady_clock::now().time_since_epoch() + std::chrono::nanoseconds(work_ns);
    return done <= deadline_;
  }

 private:
  Micros limit_;
  std::chrono::nanoseconds deadline_ = std::chrono::nanoseconds::max();
};

}  // namespace floornav
