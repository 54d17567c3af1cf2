#pragma once

#include <cstdint>

namespace floornav {

/// What a step may still spend. Live it is a deadline on the monotonic clock; in replay it is unlimited or
/// counted in work, so that the same log gives the same result.
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

}  // namespace floornav
