#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace floornav {

/// What a node may still spend on the work that it has begun. Live it is a deadline on the monotonic clock;
/// in replay it is unlimited or counted in work, so that the same log gives the same result. It begins anew
/// whenever the node had nothing left to do.
class Budget {
 public:
  virtual ~Budget() = default;
  /// Asks for `work` nanoseconds' worth of work (as estimated, the same on every machine). False: leave it
  /// out.
  virtual bool spend(std::int64_t work_ns) = 0;
};

class UnlimitedBudget final : public Budget {
 public:
  bool spend(std::int64_t) override { return true; }
};

/// Counts work: what exceeds the limit is refused, smaller work may still fit.
class WorkBudget final : public Budget {
 public:
  explicit WorkBudget(std::int64_t limit_ns) : left_ns_(limit_ns) {}
  bool spend(std::int64_t work_ns) override {
    if (work_ns > left_ns_) return false;
    left_ns_ -= work_ns;
    return true;
  }

 private:
  std::int64_t left_ns_;
};

/// Refuses what would not be done by an instant of the monotonic clock.
class DeadlineBudget final : public Budget {
 public:
  explicit DeadlineBudget(std::chrono::steady_clock::time_point deadline) : deadline_(deadline) {}
  bool spend(std::int64_t work_ns) override {
    return std::chrono::steady_clock::now() + std::chrono::nanoseconds(work_ns) <= deadline_;
  }

 private:
  std::chrono::steady_clock::time_point deadline_;
};

}  // namespace floornav
