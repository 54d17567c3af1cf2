#include "runtime/process/fault_log.hpp"

#include <algorithm>

#include "runtime/process/health.hpp"

namespace floornav {

void FaultLog::add(const std::string& what, Instant now) {
  recent_.push_back(now);
  if (recent_.size() > kFault) recent_.pop_front();
  last_ = what;
  ++count_;
}

void FaultLog::report(health_t& health, Instant now) const {
  add_drop(health, "exceptions", count_);
  const auto recent =
      std::count_if(recent_.begin(), recent_.end(), [&](Instant when) { return now - when < kRemembered; });
  if (recent == 0) return;
  worsen(health, static_cast<std::size_t>(recent) >= kFault ? health_t::FAULT : health_t::DEGRADED, last_);
}

}  // namespace floornav
