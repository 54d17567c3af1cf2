#pragma once

#include <algorithm>
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
  /// A new frame begins, with a budget of its own; `arrived` is the `now` with which it was handed over. Live
  /// it also ends `at_most` after that. Before the first begin() nothing is limited.
  virtual void begin(Micros arrived, Micros at_most = Micros::max()) = 0;
  /// Asks for `work` nanoseconds' worth of work (as estimated, the same on every machine) that is to be done
  /// now, while `put_off` of what was granted before is still to come. False: leave it out.
  virtual bool spend(std::int64_t work_ns, std::int64_t put_off_ns = 0) = 0;
  /// Tells of work that is done whatever it takes.
  virtual void charge(std::int64_t work_ns) = 0;
  /// Work that could be granted now.
  [[nodiscard]] virtual std::int64_t left_ns() const = 0;
  /// All that was granted or charged since begin() has been done: live, to learn how long such work takes
  /// here.
  virtual void end() {}
};

class UnlimitedBudget final : public Budget {
 public:
  void begin(Micros, Micros) override {}
  bool spend(std::int64_t, std::int64_t) override { return true; }
  void charge(std::int64_t) override {}
  [[nodiscard]] std::int64_t left_ns() const override { return std::numeric_limits<std::int64_t>::max(); }
};

/// Counts work: what exceeds the limit is refused, smaller work may still fit.
class WorkBudget final : public Budget {
 public:
  explicit WorkBudget(std::int64_t limit_ns) : limit_ns_(limit_ns) {}
  void begin(Micros, Micros) override { left_ns_ = limit_ns_; }
  bool spend(std::int64_t work_ns, std::int64_t) override {
    if (work_ns > left_ns_) return false;
    left_ns_ -= work_ns;
    return true;
  }
  void charge(std::int64_t work_ns) override { left_ns_ -= std::min(work_ns, left_ns_); }
  [[nodiscard]] std::int64_t left_ns() const override { return left_ns_; }

 private:
  std::int64_t limit_ns_;
  std::int64_t left_ns_ = std::numeric_limits<std::int64_t>::max();
};

/// Refuses what would not be done within a time from a frame's arrival. Only for a `now` of the monotonic
/// clock.
class DeadlineBudget final : public Budget {
 public:
  explicit DeadlineBudget(Micros limit) : limit_(limit) {}
  void begin(Micros arrived, Micros at_most) override {
    deadline_ = arrived + std::min(limit_, at_most);
    began_ = now();
    promised_ns_ = 0;
  }
  bool spend(std::int64_t work_ns, std::int64_t put_off_ns) override {
    if (work_ns + put_off_ns > left_ns()) return false;
    promised_ns_ += work_ns;
    return true;
  }
  void charge(std::int64_t work_ns) override { promised_ns_ += work_ns; }
  [[nodiscard]] std::int64_t left_ns() const override {
    if (deadline_ == std::chrono::nanoseconds::max()) return std::numeric_limits<std::int64_t>::max();
    return static_cast<std::int64_t>(static_cast<double>((deadline_ - now()).count()) / slowness_);
  }
  void end() override {
    constexpr double kWeight = 0.2, kFastest = 0.05, kSlowest = 50.0;
    if (promised_ns_ <= 0) return;
    const double measured = static_cast<double>((now() - began_).count()) / static_cast<double>(promised_ns_);
    slowness_ += kWeight * (std::clamp(measured, kFastest, kSlowest) - slowness_);
  }

 private:
  [[nodiscard]] static std::chrono::nanoseconds now() {
    return std::chrono::steady_clock::now().time_since_epoch();
  }

  Micros limit_;
  std::chrono::nanoseconds deadline_ = std::chrono::nanoseconds::max();
  std::chrono::nanoseconds began_{0};
  std::int64_t promised_ns_ = 0;
  double slowness_ = 1.0;  ///< time that estimated work takes here
};

}  // namespace floornav
